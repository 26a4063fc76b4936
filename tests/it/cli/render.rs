//! `render` takes the pictures that it is asked for.

use super::{program, run};

#[test]
fn a_room_is_shown_in_colour_depth_and_mask() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("kitchen.png");
    let mut command = program();
    command.args(["render", "apartment", "--room", "Kitchen", "--size", "48x36", "--json", "-o"]);
    let output = command.arg(&file).output().unwrap();
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let picture = &document["pictures"][0];
    let things = picture["things"].as_array().unwrap();
    assert!(things.len() > 3, "{things:?}");
    for part in ["colour", "depth", "mask"] {
        let path = picture[part].as_str().unwrap();
        let mut file = png::Decoder::new(std::io::Cursor::new(std::fs::read(path).unwrap()));
        let info = file.read_header_info().unwrap();
        assert_eq!((info.width, info.height), (48, 36));
    }
}

#[test]
fn a_seed_gives_the_same_noise_each_time() {
    let folder = tempfile::tempdir().unwrap();
    let take = |name: &str, noise: &[&str]| {
        let file = folder.path().join(name);
        let mut command = program();
        command.args(["render", "apartment", "--pose", "1,1,1.2,45,-10", "--size", "32x24", "-o"]);
        assert!(command.arg(&file).args(noise).output().unwrap().status.success());
        std::fs::read(file).unwrap()
    };
    let noisy = take("a.png", &["--noise", "3"]);
    assert_eq!(noisy, take("b.png", &["--noise", "3"]));
    assert_ne!(noisy, take("c.png", &["--noise", "4"]));
    assert_ne!(noisy, take("d.png", &[]));
}

#[test]
fn what_cannot_be_shown_is_refused_with_the_mend() {
    let check = |args: &[&str], words: &[&str]| {
        let args = [&["render", "apartment", "-o", "nowhere/x.png"], args].concat();
        run(&args).expect(2).says(words);
    };
    check(&["--room", "ballroom"], &["ballroom", "there are: "]);
    check(&["--pose", "1,2"], &["x,y,z,yaw,pitch"]);
    check(&["--pose", "1,2,NaN"], &["x,y,z,yaw,pitch"]);
    check(&["--at", "1,2,3"], &["--pose"]);
    check(&["--fov", "190"], &["from 1 to 170"]);
    check(&["--size", "640"], &["640x480"]);
    check(&["--size", "0x480"], &["from 1 to"]);
    check(&[], &["folder"]);
}
