//! Houses, right and wrong.

mod floor;
mod graphs;
mod wrong;

use super::*;

/// The built-in houses.
fn houses() -> Vec<House> {
    BUILT_IN.iter().map(|it| it.house().expect("it is tested to be possible")).collect()
}

fn apartment() -> House {
    houses().swap_remove(0)
}

fn named(house: &House, name: &str) -> usize {
    house.things.iter().position(|thing| thing.name == name).unwrap()
}

#[test]
fn the_built_in_houses_are_possible() {
    let mut wrong = String::new();
    for it in BUILT_IN {
        match it.house() {
            Ok(house) => assert_eq!(house.name, it.name),
            Err(errors) => {
                wrong.extend(errors.iter().map(|error| format!("{}: {error}\n", it.name)));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn the_built_in_houses_are_full_of_different_things() {
    for house in houses() {
        let mut labels: Vec<&str> = house.things.iter().map(|it| it.label.as_str()).collect();
        assert!(labels.len() >= 45, "{}: {} things", house.name, labels.len());
        labels.sort_unstable();
        labels.dedup();
        assert!(labels.len() >= 30, "{}: {} classes", house.name, labels.len());
        assert!(house.triangles() < 40_000, "{}: {}", house.name, house.triangles());
        let known = |label: &&&str| crate::simulation::shapes::class_named(label).is_none();
        let unknown: Vec<&&str> = labels.iter().filter(known).collect();
        assert!(unknown.len() <= 1, "{}: {unknown:?}", house.name);
    }
}

#[test]
fn the_apartment_has_what_the_paper_names() {
    let house = apartment();
    let rooms: Vec<&str> = house.rooms.iter().map(|room| room.label.as_str()).collect();
    assert_eq!(rooms, ["bathroom", "bedroom", "living room", "kitchen"]);
    for (name, room, support) in [
        ("towel", "bathroom", None),
        ("mug", "kitchen", Some("dining table")),
        ("banana", "kitchen", Some("dining table")),
        ("tv remote", "living room", Some("table")),
        ("novel", "living room", Some("bookshelf")),
        ("sofa", "living room", None),
        ("bed", "bedroom", None),
        ("refrigerator", "kitchen", None),
        ("pantry", "kitchen", None),
    ] {
        let thing = &house.things[named(&house, name)];
        assert_eq!(house.rooms[thing.room].label.as_str(), room, "{name}");
        let below = thing.support.map(|n| house.things[n].name.as_str());
        assert_eq!(below, support, "{name}");
    }
    for name in ["mug", "banana", "towel", "tv remote", "bed", "sofa", "nightstand"] {
        let label = &house.things[named(&house, name)].label;
        let same = house.things.iter().filter(|thing| thing.label == *label).count();
        assert_eq!(same, 1, "{name}");
    }
}

/// Whether thing `n` fits somewhere on a surface, in one of two turns.
fn fits_on(house: &House, n: usize, support: usize, surface: &str) -> bool {
    let space = Space::new(house);
    let thing = &house.things[n];
    let below = &house.things[support];
    below.surfaces.iter().filter(|it| it.name == surface).any(|surface| {
        let it = below.surface_in_world(surface);
        let turned = |quarter: f64| {
            let half = quarter * std::f64::consts::FRAC_PI_4;
            [libm::cos(half), 0.0, 0.0, libm::sin(half)]
        };
        (-8..=8).flat_map(|i| (-8..=8).map(move |j| (f64::from(i), f64::from(j)))).any(|(i, j)| {
            let [a, b] = [it.half[0] * i / 8.0, it.half[1] * j / 8.0];
            let [c, s] = it.along;
            let at = [it.centre[0] + a * c - b * s, it.centre[1] + a * s + b * c];
            let z = it.z + thing.size.metres()[2] / 2.0;
            [0.0, 1.0].into_iter().any(|quarter| {
                let pose = Pose::new([at[0], at[1], z], turned(quarter)).unwrap();
                space.fits(n, thing.size, &pose, &it).is_ok()
            })
        })
    })
}

#[test]
fn the_mission_has_room_for_what_it_moves() {
    let house = apartment();
    for (thing, support, surface) in [
        ("tv remote", "sofa", "arm"),
        ("tv remote", "sofa", "seat"),
        ("mug", "nightstand", "top"),
        ("novel", "bed", "top"),
        ("banana", "counter", "top"),
    ] {
        let (n, on) = (named(&house, thing), named(&house, support));
        assert!(fits_on(&house, n, on, surface), "{thing} on the {surface} of the {support}");
    }
    let (sofa, mug) = (named(&house, "sofa"), named(&house, "mug"));
    assert!(!fits_on(&house, sofa, named(&house, "bed"), "top"));
    assert!(!fits_on(&house, mug, named(&house, "bookshelf"), "no such surface"));
}

#[test]
fn what_does_not_fit_is_told_why() {
    let house = apartment();
    let space = Space::new(&house);
    let (mug, table) = (named(&house, "mug"), named(&house, "dining table"));
    let top = house.things[table].surface_in_world(&house.things[table].surfaces[0]);
    let thing = &house.things[mug];
    let at = |dx: f64, dz: f64| {
        let [x, y, z] = thing.pose.position();
        Pose::at([x + dx, y, z + dz]).unwrap()
    };
    let fits = |pose: &Pose| space.fits(mug, thing.size, pose, &top);
    assert_eq!(fits(&at(0.0, 0.0)), Ok(()));
    assert!(matches!(fits(&at(3.0, 0.0)), Err(Misfit::JutsOut { .. })));
    assert!(matches!(fits(&at(0.0, 0.1)), Err(Misfit::Floats { .. })));
    let bottle = named(&house, "bottle");
    let [x, y, _] = house.things[bottle].pose.position();
    let into = Pose::at([x, y, thing.pose.position()[2]]).unwrap();
    assert_eq!(
        fits(&into)
            .map_err(|it| matches!(it, Misfit::Occupied { other: Some(n), .. } if n == bottle)),
        Err(true)
    );
}

#[test]
fn the_schema_is_that_of_the_type() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("schemas/house.schema.json");
    let schema = schemars::schema_for!(HouseFile);
    let text = serde_json::to_string_pretty(&schema).unwrap() + "\n";
    if std::env::var_os("SCENEFOLD_WRITE_SCHEMAS").is_some() {
        std::fs::write(&path, &text).unwrap();
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(committed == text, "run the test with SCENEFOLD_WRITE_SCHEMAS=1 and commit the file");
}

#[test]
fn a_house_file_reads_back_as_it_was_written() {
    for it in BUILT_IN {
        let file = read(it.json).unwrap();
        let again = read(&serde_json::to_string(&file).unwrap()).unwrap();
        assert_eq!(again, file);
    }
}
