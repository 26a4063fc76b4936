//! Where the things of a house file stand.

use super::objects::Draft;
use super::rooms::room_named;
use super::{Complaints, in_range};
use crate::geometry::{Pose, Size};
use crate::simulation::house::space::{SurfaceInWorld, surface_in_world};
use crate::simulation::house::{House, HouseError, HouseFile, ObjectFile, Thing};
use crate::simulation::shapes::polygon;

/// Puts the drafts where the file says; each after what it stands on.
pub fn place(
    file: &HouseFile,
    house: &House,
    drafts: Vec<Draft>,
    rooms: &[String],
    wrong: &mut Complaints,
) -> Vec<Thing> {
    let names: Vec<String> = drafts.iter().map(|draft| draft.name.clone()).collect();
    let supports: Vec<Option<usize>> = file
        .objects
        .iter()
        .enumerate()
        .map(|(n, object)| support(object, n, &names, wrong))
        .collect();
    let Some(order) = order(&supports, wrong) else { return Vec::new() };
    let mut things: Vec<Option<Thing>> = (0..drafts.len()).map(|_| None).collect();
    let mut drafts: Vec<Option<Draft>> = drafts.into_iter().map(Some).collect();
    for n in order {
        let Some(draft) = drafts[n].take() else { continue };
        let below = supports[n].map(|below| (below, things[below].as_ref()));
        // What it stands on was refused: that has been told.
        if matches!(below, Some((_, None))) {
            continue;
        }
        let below = below.and_then(|(below, thing)| Some((below, thing?)));
        things[n] = thing(&file.objects[n], n, draft, below, (house, rooms), wrong);
    }
    things.into_iter().flatten().collect()
}

fn support(
    object: &ObjectFile,
    n: usize,
    names: &[String],
    wrong: &mut Complaints,
) -> Option<usize> {
    let path = |field: &str| format!("objects[{n}].{field}");
    let Some(name) = &object.support else {
        if object.surface.is_some() {
            let problem = "a surface of what? give support too";
            wrong.push(HouseError::new(path("surface"), problem));
        }
        return None;
    };
    let found = names.iter().position(|known| known == name);
    if found.is_none() {
        let problem = format!("there is no object named {name:?}");
        wrong.push(HouseError::new(path("support"), problem));
    }
    found
}

/// Numbers of the things so that each comes after what it stands on.
fn order(supports: &[Option<usize>], wrong: &mut Complaints) -> Option<Vec<usize>> {
    let mut order: Vec<usize> = Vec::new();
    let mut done = vec![false; supports.len()];
    while order.len() < supports.len() {
        let ready = |n: &usize| !done[*n] && supports[*n].is_none_or(|below| done[below]);
        let next: Vec<usize> = (0..supports.len()).filter(ready).collect();
        if next.is_empty() {
            let n = done.iter().position(|done| !done)?;
            let problem = "it stands on itself in the end: one of them must stand on the floor";
            wrong.push(HouseError::new(format!("objects[{n}].support"), problem));
            return None;
        }
        next.iter().for_each(|n| done[*n] = true);
        order.extend(next);
    }
    Some(order)
}

fn thing(
    file: &ObjectFile,
    n: usize,
    draft: Draft,
    below: Option<(usize, &Thing)>,
    (house, rooms): (&House, &[String]),
    wrong: &mut Complaints,
) -> Option<Thing> {
    let path = format!("objects[{n}]");
    let turn = orientation(file, &path, wrong)?;
    let at = position(file, &path, wrong)?;
    let flat = Pose::new([at[0], at[1], 0.0], turn).ok()?;
    let lift = lift(&flat, draft.size);
    let z = match (at.get(2), below) {
        (Some(z), _) => *z,
        (None, None) => lift,
        (None, Some((_, below))) => {
            let found = surface_under(file, below, &flat, draft.size);
            let problem = |why| format!("{:?}: {why}", draft.name);
            let surface = found.map_err(|why| wrong.push(HouseError::new(&path, problem(why))));
            surface.ok()?.z + lift
        }
    };
    let pose = Pose::new([at[0], at[1], z], turn).map_err(|error| {
        wrong.push(HouseError::new(format!("{path}.position"), error.to_string()))
    });
    let room = room(file, &path, [at[0], at[1]], (house, rooms), wrong)?;
    let Draft { name, label, size, mesh, surfaces, movable, decay_rate } = draft;
    let (pose, support) = (pose.ok()?, below.map(|(below, _)| below));
    Some(Thing { name, label, pose, size, mesh, movable, decay_rate, room, support, surfaces })
}

/// How high the centre of a box is when it stands on the floor, turned as `pose` says.
pub fn lift(pose: &Pose, size: Size) -> f64 {
    let turn = pose.isometry().rotation.to_rotation_matrix();
    let half = size.metres().map(|side| side / 2.0);
    (0..3).map(|k| turn[(2, k)].abs() * half[k]).sum()
}

fn orientation(file: &ObjectFile, path: &str, wrong: &mut Complaints) -> Option<[f64; 4]> {
    let wxyz = match (file.yaw, file.orientation) {
        (Some(_), Some(_)) => {
            wrong.push(HouseError::new(path, "give yaw or orientation, not both"));
            return None;
        }
        (None, Some(q)) => [q.w, q.x, q.y, q.z],
        (yaw, None) => {
            let degrees = yaw.unwrap_or(0.0);
            if !in_range(&format!("{path}.yaw"), degrees, [-360.0, 360.0], wrong) {
                return None;
            }
            let half = degrees.to_radians() / 2.0;
            [libm::cos(half), 0.0, 0.0, libm::sin(half)]
        }
    };
    Pose::new([0.0; 3], wxyz)
        .map_err(|error| {
            wrong.push(HouseError::new(format!("{path}.orientation"), error.to_string()));
        })
        .ok()?;
    Some(wxyz)
}

fn position(file: &ObjectFile, path: &str, wrong: &mut Complaints) -> Option<Vec<f64>> {
    let at = &file.position;
    if !(2..=3).contains(&at.len()) {
        let problem = format!("{} numbers must be two ([x, y]) or three", at.len());
        wrong.push(HouseError::new(format!("{path}.position"), problem));
        return None;
    }
    let fine = at.iter().enumerate().all(|(k, value)| {
        in_range(&format!("{path}.position[{k}]"), *value, [-1_000.0, 1_000.0], wrong)
    });
    fine.then(|| at.clone())
}

/// The surface of `below` on which a box fits: the one that the file names, or the first.
fn surface_under(
    file: &ObjectFile,
    below: &Thing,
    flat: &Pose,
    size: Size,
) -> Result<SurfaceInWorld, String> {
    let all = || below.surfaces.iter().map(|surface| surface_in_world(below, surface));
    if below.surfaces.is_empty() {
        return Err(format!("nothing can be put on {:?}: give z as position[2]", below.name));
    }
    let wanted = file.surface.as_deref();
    let named: Vec<SurfaceInWorld> = match wanted {
        None => all().collect(),
        Some(name) => {
            numbered(&below.surfaces, name).into_iter().filter_map(|n| all().nth(n)).collect()
        }
    };
    if named.is_empty() {
        let known: Vec<&str> = below.surfaces.iter().map(|surface| surface.name.as_str()).collect();
        let wanted = wanted.unwrap_or_default();
        return Err(format!(
            "{:?} has no surface {wanted:?}; it has {}",
            below.name,
            known.join(", ")
        ));
    }
    let fitting = named.iter().find(|surface| surface.holds(flat, size).is_ok());
    fitting.cloned().ok_or_else(|| {
        let why = named[0].holds(flat, size).expect_err("none holds it");
        format!("{why} (surface {:?} of {:?})", named[0].name, below.name)
    })
}

/// Numbers of the surfaces called `name`: "shelf" are all of that name, "shelf 2" the second.
fn numbered(surfaces: &[crate::simulation::house::Surface], name: &str) -> Vec<usize> {
    let called = |name: &str| -> Vec<usize> {
        (0..surfaces.len()).filter(|n| surfaces[*n].name.eq_ignore_ascii_case(name)).collect()
    };
    let (stem, number) = name.rsplit_once(' ').unwrap_or((name, ""));
    let exact = called(name);
    match number.parse::<usize>() {
        Ok(number) if exact.is_empty() => {
            called(stem).get(number.wrapping_sub(1)).copied().into_iter().collect()
        }
        _ => exact,
    }
}

fn room(
    file: &ObjectFile,
    path: &str,
    at: [f64; 2],
    (house, rooms): (&House, &[String]),
    wrong: &mut Complaints,
) -> Option<usize> {
    let here = house.rooms.iter().position(|room| polygon::contains(&room.outline, at));
    let [x, y] = at;
    let Some(name) = &file.room else {
        if here.is_none() {
            let problem = format!("({x}, {y}) is in no room");
            wrong.push(HouseError::new(format!("{path}.position"), problem));
        }
        return here;
    };
    let named = room_named(name, rooms, &format!("{path}.room"), wrong)?;
    if here != Some(named) {
        let really = here.map_or("in no room".to_owned(), |n| format!("in the {}", rooms[n]));
        let problem = format!("({x}, {y}) is {really}, not in the {name}");
        wrong.push(HouseError::new(format!("{path}.position"), problem));
        return None;
    }
    Some(named)
}
