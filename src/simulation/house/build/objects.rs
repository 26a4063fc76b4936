//! Things of a house file, before it is known where they stand.

use std::path::Path;
use std::sync::Arc;

use super::{Complaints, in_range, look};
use crate::geometry::Size;
use crate::graph::Label;
use crate::simulation::house::{
    HouseError, HouseFile, ObjectFile, Surface, decay_class, decay_rate_of, obj,
};
use crate::simulation::mesh::Mesh;
use crate::simulation::shapes;

/// A thing without its place.
pub struct Draft {
    pub name: String,
    pub label: Label,
    pub size: Size,
    pub mesh: Arc<Mesh>,
    pub surfaces: Vec<Surface>,
    pub movable: bool,
    pub decay_rate: f64,
}

/// All things of a file; as many as there are if nothing is wrong.
pub fn read(file: &HouseFile, folder: Option<&Path>, wrong: &mut Complaints) -> Vec<Draft> {
    let names = names(file, wrong);
    let mut drafts: Vec<Draft> = Vec::new();
    for (n, (object, name)) in file.objects.iter().zip(names).enumerate() {
        let Some(mut draft) = one(object, &format!("objects[{n}]"), name, folder, wrong) else {
            continue;
        };
        // What looks the same is one mesh: whoever draws it does the work once.
        if let Some(twin) = drafts.iter().find(|other| other.mesh == draft.mesh) {
            draft.mesh = twin.mesh.clone();
        }
        drafts.push(draft);
    }
    drafts
}

/// Names as given, or made from labels: "mug", "mug 2".
fn names(file: &HouseFile, wrong: &mut Complaints) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    let given: Vec<&String> = file.objects.iter().filter_map(|it| it.name.as_ref()).collect();
    for (n, object) in file.objects.iter().enumerate() {
        let name = object.name.clone().unwrap_or_else(|| {
            let numbered = (1_usize..).map(|k| match k {
                1 => object.label.clone(),
                _ => format!("{} {k}", object.label),
            });
            let free = |name: &String| !names.contains(name) && !given.contains(&name);
            numbered.into_iter().find(free).expect("numbers do not end")
        });
        if let Some(first) = names.iter().position(|other| *other == name) {
            let problem = format!("{name:?} is the name of objects[{first}] too: give another");
            wrong.push(HouseError::new(format!("objects[{n}].name"), problem));
        }
        names.push(name);
    }
    names
}

fn one(
    file: &ObjectFile,
    path: &str,
    name: String,
    folder: Option<&Path>,
    wrong: &mut Complaints,
) -> Option<Draft> {
    let label = Label::new(&file.label)
        .map_err(|error| wrong.push(HouseError::new(format!("{path}.label"), error.to_string())));
    let size = size(file, path, wrong)?;
    let (mut mesh, surfaces) = mesh(file, size, path, folder, wrong)?;
    paint(file, &mut mesh, path, wrong);
    let decay_rate = decay(file, path, wrong)?;
    Some(Draft {
        name,
        label: label.ok()?,
        size,
        mesh: Arc::new(mesh),
        surfaces,
        movable: file.movable.unwrap_or(decay_rate > 0.0),
        decay_rate,
    })
}

fn size(file: &ObjectFile, path: &str, wrong: &mut Complaints) -> Option<Size> {
    let spec = file.mesh.as_deref().unwrap_or(&file.label);
    let class = shapes::class_named(spec).or_else(|| shapes::class_named(&file.label));
    let Some(sides) = file.size.or(class.map(|class| class.usual_m)) else {
        let problem =
            format!("the usual size of {:?} is not known: give size [w, h, d]", file.label);
        wrong.push(HouseError::new(path, problem));
        return None;
    };
    let mut fine = true;
    for (k, side) in sides.into_iter().enumerate() {
        if !(side >= 0.001 && side <= 20.0) {
            let problem = format!("a box side of {side} must be 0.001 to 20 m");
            wrong.push(HouseError::new(format!("{path}.size[{k}]"), problem));
            fine = false;
        }
    }
    let [w, h, d] = sides;
    if fine { Size::new(w, h, d).ok() } else { None }
}

fn mesh(
    file: &ObjectFile,
    size: Size,
    path: &str,
    folder: Option<&Path>,
    wrong: &mut Complaints,
) -> Option<(Mesh, Vec<Surface>)> {
    let Some(spec) = &file.mesh else { return Some(shapes::drawn(&file.label, size)) };
    if spec == "box" {
        return Some(shapes::plain_shape(&file.label, size));
    }
    let path = format!("{path}.mesh");
    if Path::new(spec).extension().is_some_and(|end| end.eq_ignore_ascii_case("obj")) {
        let file = folder.unwrap_or(Path::new("")).join(spec);
        return obj::read(&file, size)
            .map_err(|error| wrong.push(HouseError::new(path, error.to_string())))
            .ok();
    }
    if shapes::class_named(spec).is_none() {
        let known: Vec<&str> = shapes::classes().map(|class| class.name).collect();
        let problem = format!(
            "{spec:?} is not known: give \"box\", the path of an .obj file, or one of {}",
            known.join(", ")
        );
        wrong.push(HouseError::new(path, problem));
        return None;
    }
    Some(shapes::drawn(spec, size))
}

/// Replaces the main colour and texture by those of the file.
fn paint(file: &ObjectFile, mesh: &mut Mesh, path: &str, wrong: &mut Complaints) {
    let Some(main) = mesh.materials.first_mut() else { return };
    if let Some(text) = &file.colour {
        main.colour = look::colour(text, &format!("{path}.colour"), wrong);
    }
    if let Some(texture) = &file.texture {
        main.texture = look::texture(texture, &format!("{path}.texture"), wrong);
    }
}

/// λ in 1/s.
fn decay(file: &ObjectFile, path: &str, wrong: &mut Complaints) -> Option<f64> {
    let usual = shapes::class_named(&file.label).map(|class| class.decay);
    match (&file.decay, file.half_life_h) {
        (Some(_), Some(_)) => {
            wrong.push(HouseError::new(path, "give decay or half_life_h, not both"));
            None
        }
        (None, Some(hours)) => {
            let path = format!("{path}.half_life_h");
            in_range(&path, hours, [0.01, 1.0e6], wrong).then(|| decay_rate_of(hours))
        }
        (given, None) => {
            // What nobody knows is taken to be carried about like a device, unless it is large.
            let heavy = file.size.is_some_and(|sides| sides.iter().any(|side| *side > 0.6));
            let otherwise = if heavy { "furniture" } else { "device" };
            let name = given.as_deref().or(usual).unwrap_or(otherwise);
            let found = decay_class(name);
            if found.is_none() {
                let known: Vec<&str> =
                    crate::simulation::house::DECAY_CLASSES.iter().map(|it| it.name).collect();
                let problem = format!("{name:?} is no decay class; there are {}", known.join(", "));
                wrong.push(HouseError::new(format!("{path}.decay"), problem));
            }
            Some(found?.decay_rate())
        }
    }
}
