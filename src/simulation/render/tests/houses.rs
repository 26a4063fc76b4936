//! Built-in houses as scenes.

use nalgebra::Point3;

use crate::geometry::{Camera, looking_at};
use crate::simulation::house::{BUILT_IN, House};
use crate::simulation::render::HouseScene;
use crate::simulation::sensor::{NoiseConfig, Picture, jpeg};

fn houses() -> impl Iterator<Item = House> {
    BUILT_IN.iter().map(|house| house.house().unwrap())
}

#[test]
fn every_room_can_be_looked_into_and_has_light() {
    let camera = Camera::with_fov(40, 30, 1.3);
    for house in houses() {
        let scene = HouseScene::new(&house);
        let mut furnished = 0;
        for (n, room) in house.rooms.iter().enumerate() {
            let frame = scene.scene.render(&camera, &scene.view_of(room));
            let own = |mask: &u16| {
                let thing = mask.checked_sub(1).map(|thing| &house.things[usize::from(thing)]);
                thing.is_some_and(|thing| thing.room == n)
            };
            let things = frame.mask.iter().filter(|mask| own(mask)).count();
            furnished += usize::from(things > 20);
            let sum: u32 = frame.colour.iter().flatten().map(|part| u32::from(*part)).sum();
            let mean = sum / (3 * 40 * 30);
            let name = room.label.as_str();
            assert!((70..200).contains(&mean), "{}: {name} is {mean} bright", house.name);
        }
        // A corridor may hold nothing that is seen from where most of it is seen.
        assert!(furnished + 1 >= house.rooms.len(), "{}: {furnished} rooms", house.name);
    }
}

#[test]
fn a_mask_is_the_number_of_the_thing_plus_one() {
    let house = houses().next().unwrap();
    let scene = HouseScene::new(&house);
    let mut seen = 0;
    for (n, thing) in house.things.iter().enumerate() {
        let middle = thing.pose.point();
        let above = Point3::new(middle.x + 0.01, middle.y, middle.z + 0.4 + thing.size.metres()[2]);
        let camera = Camera::with_fov(9, 9, 0.6);
        let frame = scene.scene.render(&camera, &looking_at(above, middle));
        seen += usize::from(frame.mask.contains(&(n as u16 + 1)));
    }
    assert!(seen * 2 > house.things.len(), "{seen} of {} things", house.things.len());
}

/// A mission of some hundred pictures is to be of a few megabytes.
#[test]
fn pictures_of_rooms_stay_small() {
    let camera = Camera::with_fov(320, 240, 1.2);
    let house = houses().next().unwrap();
    let scene = HouseScene::new(&house);
    let (mut colour, mut depth) = (0, Vec::new());
    for (n, room) in house.rooms.iter().enumerate() {
        let frame = scene.scene.render(&camera, &scene.view_of(room));
        let picture = Picture::take(&frame, &camera, &NoiseConfig::default(), 1, n as u64);
        colour += jpeg(320, 240, &picture.colour, 80).unwrap().len() / house.rooms.len();
        depth.extend(picture.depth_mm.iter().flat_map(|mm| mm.to_le_bytes()));
    }
    let packed =
        |level: i32| zstd::bulk::compress(&depth, level).unwrap().len() / house.rooms.len();
    println!("JPEG {colour}, depth by zstd 3 {}, 9 {}, 19 {}", packed(3), packed(9), packed(19));
    assert!(colour < 14_000, "{colour} bytes of JPEG a picture");
    assert!(packed(3) < 24_000, "{} bytes of depth a picture", packed(3));
}
