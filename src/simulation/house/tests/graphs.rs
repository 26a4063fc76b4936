//! Houses to graphs, graphs to houses.

use super::*;
use crate::graph::{Layer, NodeId};
use crate::time::Stamp;

fn shared(path: &str) -> Option<std::path::PathBuf> {
    let folder = std::env::var("SCENEFOLD_SHARED_DATA").ok()?;
    Some(std::path::Path::new(&folder).join(path))
}

#[test]
fn the_graph_of_a_house_numbers_its_rooms_and_things_in_order() {
    for house in houses() {
        let graph = house.graph(Stamp::from_nanos(5));
        assert_eq!(graph.rooms().count(), house.rooms.len());
        assert_eq!(graph.object_count(), house.things.len());
        for (n, thing) in house.things.iter().enumerate() {
            let id = |layer, n: usize| NodeId::new(layer, n as u32 + 1).unwrap();
            let object = graph.object(id(Layer::Object, n)).unwrap();
            assert_eq!((&object.label, object.pose), (&thing.label, thing.pose));
            assert_eq!(object.room, id(Layer::Room, thing.room));
            assert_eq!(object.support, thing.support.map(|below| id(Layer::Object, below)));
            assert!((object.decay_rate > 0.0) == thing.movable, "{}", thing.name);
        }
        let doors: std::collections::BTreeSet<_> = house
            .doors
            .iter()
            .map(|door| (door.rooms[0].min(door.rooms[1]), door.rooms[0].max(door.rooms[1])))
            .collect();
        assert_eq!(graph.access().count(), doors.len());
    }
}

#[test]
fn a_house_goes_through_its_graph_and_comes_back() {
    for house in houses().into_iter().filter(|house| house.name != "loft") {
        let made = from_graph(&house.graph(Stamp::from_nanos(0)), &house.name).unwrap();
        assert_eq!(made.house.rooms.len(), house.rooms.len());
        assert_eq!(made.house.doors.len(), house.doors.len(), "{:?}", made.notes);
        // A window is no door, a rug no floor: everything but those comes back.
        assert_eq!(made.house.things.len(), house.things.len(), "{:?}", made.notes);
        for (a, b) in made.house.things.iter().zip(&house.things) {
            assert_eq!(a.label, b.label);
            assert!(a.pose.distance(&b.pose).0 < 0.01, "{}", b.name);
        }
    }
}

/// What every house is, even one that nobody drew: it can be simulated.
fn check_sound(house: &House) {
    let space = Space::new(house);
    let mut names: Vec<&str> = house.things.iter().map(|thing| thing.name.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), house.things.len());
    for thing in &house.things {
        let room = &house.rooms[thing.room];
        let block = footprint(&thing.pose, thing.size);
        assert!(crate::simulation::shapes::polygon::contains(&room.outline, block.centre));
        assert!(block.z[0] > -0.01 && block.z[1] < house.wall_height_m + 0.01, "{}", thing.name);
        assert!(space.to_wall(&thing.pose, thing.size) > -0.01, "{} is in a wall", thing.name);
        assert!(thing.support.is_none_or(|below| below < house.things.len()));
    }
    for door in &house.doors {
        assert!(
            door.rooms.iter().all(|n| *n < house.rooms.len()) && door.rooms[0] != door.rooms[1]
        );
    }
}

#[test]
fn a_virtualhome_apartment_becomes_a_house() {
    let Some(path) = shared("virtualhome/scene2.json") else { return };
    let loaded = load_reported(&path.display().to_string()).unwrap();
    let house = &loaded.house;
    check_sound(house);
    let rooms: Vec<&str> = house.rooms.iter().map(|room| room.label.as_str()).collect();
    assert_eq!(rooms, ["bathroom", "kitchen", "bedroom", "living room"]);
    // The kitchen lies between the three others.
    assert_eq!(house.doors.len(), 3, "{:?}", house.doors);
    assert!(house.things.len() > 190, "{}: {:?}", house.things.len(), loaded.notes);
    let kitchen = house.rooms[1].area_m2();
    assert!((kitchen - 56.25).abs() < 0.5, "{kitchen}");
    assert_eq!(house.graph(Stamp::from_nanos(0)).object_count(), house.things.len());
}

#[test]
fn a_graph_of_rooms_in_a_row_gets_doors() {
    let text = r#"{"rooms": [
        {"id": "R1", "label": "hall", "pose": {"position": [1.5, 1.5, 1.25], "orientation": {"w": 1, "x": 0, "y": 0, "z": 0}}, "size": [3, 3, 2.5]},
        {"id": "R2", "label": "den", "pose": {"position": [4.65, 1.5, 1.25], "orientation": {"w": 1, "x": 0, "y": 0, "z": 0}}, "size": [3, 3, 2.5]}],
        "objects": [{"label": "mug", "room": "R1", "size": [0.1, 0.1, 0.1]},
                    {"label": "sofa", "room": "R2", "size": [9, 1, 1]}]}"#;
    let graph = crate::interchange::scene::import(text).unwrap().graph;
    let made = from_graph(&graph, "row").unwrap();
    assert_eq!(made.house.doors.len(), 1);
    assert_eq!(made.house.things.len(), 1);
    assert!(made.notes.iter().any(|note| note.contains("sofa")), "{:?}", made.notes);
    assert!(made.notes.iter().any(|note| note.contains("a door was made")), "{:?}", made.notes);
    check_sound(&made.house);
}

#[test]
fn files_are_told_apart_by_what_they_hold() {
    for (text, expected) in [
        (BUILT_IN[0].json, FileKind::House),
        (r#"{"nodes": [], "edges": []}"#, FileKind::VirtualHome),
        (r#"{"at": "2026-01-05T00:00:00Z", "rooms": []}"#, FileKind::Scene),
        (r#"{"rooms": [{"label": "den"}], "objects": []}"#, FileKind::Scene),
        ("{", FileKind::House),
    ] {
        assert_eq!(kind(text), expected, "{}", &text[..text.len().min(40)]);
    }
}

#[test]
fn names_that_are_no_houses_are_told() {
    let error = load("chateau").unwrap_err().to_string();
    assert!(error.contains("chateau") && error.contains("apartment, cottage, loft"), "{error}");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.json");
    std::fs::write(&path, r#"{"name": "x", "rooms": [{"label": "den", "box": [0, 0, 1]}]}"#)
        .unwrap();
    let error = load(&path.display().to_string()).unwrap_err().to_string();
    assert!(error.contains("mine.json") && error.contains("rooms[0].box"), "{error}");
}

const CUBE: &str = "mtllib cube.mtl
v 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nv 0 0 3\nv 1 0 3\nv 1 2 3\nv 0 2 3
usemtl red
f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 4 1 5 8\n";

#[test]
fn an_obj_file_fills_the_box_in_its_colours() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("cube.obj"), CUBE).unwrap();
    std::fs::write(folder.path().join("cube.mtl"), "newmtl red\nKd 0.8 0.1 0.1\n").unwrap();
    let path = folder.path().join("mine.json");
    let text = r#"{"name": "x", "rooms": [{"label": "den", "box": [0, 0, 4, 4]}], "objects":
        [{"label": "crate", "position": [2, 2], "size": [0.4, 0.6, 0.2], "mesh": "cube.obj"}]}"#;
    std::fs::write(&path, text).unwrap();
    let house = load(&path.display().to_string()).unwrap();
    let mesh = &house.things[0].mesh;
    assert_eq!(mesh.triangles.len(), 12);
    for (k, half) in [0.2_f32, 0.3, 0.1].into_iter().enumerate() {
        let reach = mesh.vertices.iter().map(|v| v[k].abs()).fold(0.0, f32::max);
        assert!((reach - half).abs() < 1e-6);
    }
    let material = mesh.materials[usize::from(mesh.material_of[0])];
    assert_eq!(material.colour.map(f32::to_bits), [0.8_f32, 0.1, 0.1].map(f32::to_bits));
    // Faces outwards still: the volume is positive.
    let volume: f32 = mesh
        .triangles
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(|n| nalgebra::Vector3::from(mesh.vertices[n as usize]));
            a.dot(&b.cross(&c)) / 6.0
        })
        .sum();
    assert!((volume - 0.048).abs() < 1e-4, "{volume}");
}

#[test]
fn an_obj_file_that_is_none_is_told() {
    let folder = tempfile::tempdir().unwrap();
    for (text, word) in [
        ("v 0 0\n", "not a Wavefront OBJ"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "not a Wavefront OBJ"),
        ("# empty\n", "no triangle"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "flat"),
    ] {
        let path = folder.path().join("bad.obj");
        std::fs::write(&path, text).unwrap();
        let size = Size::new(1.0, 1.0, 1.0).unwrap();
        let error = obj::read(&path, size).unwrap_err().to_string();
        assert!(error.contains(word) && error.contains("bad.obj"), "{text:?}: {error}");
    }
}
