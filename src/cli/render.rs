//! `scenefold render`

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::Context;
use nalgebra::{Isometry3, Point3};
use serde::Serialize;

use super::output::{Output, plain};
use super::{Outcome, UsageError};
use crate::geometry::{Camera, looking_along, looking_at};
use crate::simulation::house::{House, load_reported};
use crate::simulation::render::{Frame, HouseScene, depth_colours};
use crate::simulation::sensor::{NoiseConfig, Picture, png};

/// Most pixels of a picture.
const PIXELS_MAX: u64 = 64 << 20;

/// Take pictures of a house: colour, depth and which thing is where
#[derive(Debug, clap::Args)]
#[command(after_help = "\
HOUSE is the name of a built-in house, a house file, or the graph of a VirtualHome apartment.
World frame: x and y along the floor, z up, metres; yaw counter-clockwise from x, pitch upwards,
degrees. Depth is shown from blue (near) to red (far), black where there is none.

Examples:
  scenefold render apartment -o pictures                        one of each room
  scenefold render apartment --room kitchen -o kitchen.png      and kitchen-depth.png, kitchen-mask.png
  scenefold render apartment --pose 2,1.5,1.2,90,-15 -o eye.png from a pose
  scenefold render apartment --pose 2,1.5,1.2 --at 4,3,0.8 -o eye.png
  scenefold render apartment --room kitchen --noise 7 -o k.png  as a real camera sees it")]
pub struct Render {
    /// A house: name or file
    #[arg(value_name = "HOUSE")]
    house: String,
    /// Where the camera is: x,y,z or x,y,z,yaw,pitch
    #[arg(
        long,
        value_name = "X,Y,Z[,YAW,PITCH]",
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    pose: Vec<f64>,
    /// Look into this room from a corner; all rooms if neither this nor --pose is given
    #[arg(long, value_name = "LABEL", conflicts_with = "pose")]
    room: Option<String>,
    /// What the camera looks at: x,y,z
    #[arg(
        long,
        value_name = "X,Y,Z",
        value_delimiter = ',',
        allow_hyphen_values = true,
        requires = "pose"
    )]
    at: Vec<f64>,
    /// Size of the picture
    #[arg(long, value_name = "WxH", default_value = "640x480", value_parser = size)]
    size: (u32, u32),
    /// Horizontal field of view, degrees
    #[arg(long, value_name = "DEGREES", default_value_t = 75.0)]
    fov: f64,
    /// Add the noise of a real camera, from this seed
    #[arg(long, value_name = "SEED")]
    noise: Option<u64>,
    /// A PNG file for one picture (its depth and mask go beside it), or a folder
    #[arg(short, long, value_name = "OUT")]
    out: PathBuf,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct RenderDocument {
    house: String,
    pictures: Vec<PictureDocument>,
}

#[derive(Serialize)]
struct PictureDocument {
    /// What it shows, by the option that asked for it.
    view: String,
    /// The camera, world frame, metres.
    position: [f64; 3],
    colour: PathBuf,
    depth: PathBuf,
    mask: PathBuf,
    /// Labels of the things in it.
    things: Vec<String>,
}

/// Runs `scenefold render`.
pub fn run(args: &Render, out: &mut Output) -> anyhow::Result<Outcome> {
    let camera = args.camera()?;
    let loaded = load_reported(&args.house)?;
    for note in &loaded.notes {
        let _ = writeln!(std::io::stderr(), "note: {}", plain(note));
    }
    let scene = HouseScene::new(&loaded.house);
    let views = args.views(&loaded.house, &scene)?;
    let mut pictures = Vec::new();
    for (n, (view, pose)) in views.iter().enumerate() {
        let frame = scene.scene.render(&camera, pose);
        let files = args.files(view, views.len())?;
        args.save(&files, &frame, &camera, n as u64)?;
        let [colour, depth, mask] = files;
        let things = things_in(&loaded.house, &frame);
        let (view, position) = (view.clone(), pose.translation.vector.into());
        pictures.push(PictureDocument { view, position, colour, depth, mask, things });
    }
    let document = RenderDocument { house: loaded.house.name, pictures };
    if args.json {
        out.json(&document)?;
    } else {
        print(&document, out)?;
    }
    Ok(Outcome::Clean)
}

impl Render {
    fn camera(&self) -> anyhow::Result<Camera> {
        if !(1.0..=170.0).contains(&self.fov) {
            let problem = format!("--fov is {}: it must be from 1 to 170 degrees", self.fov);
            return Err(UsageError(problem).into());
        }
        let (width, height) = self.size;
        Ok(Camera::with_fov(width, height, self.fov.to_radians()))
    }

    /// What is to be shown, and from where.
    fn views(
        &self,
        house: &House,
        scene: &HouseScene,
    ) -> anyhow::Result<Vec<(String, Isometry3<f64>)>> {
        if let Some(pose) = self.given_pose()? {
            return Ok(vec![("pose".to_owned(), pose)]);
        }
        let wanted = |label: &str| self.room.as_ref().is_none_or(|room| same(room, label));
        let rooms = house.rooms.iter().filter(|room| wanted(room.label.as_str()));
        let views: Vec<_> =
            rooms.map(|room| (room.label.as_str().to_owned(), scene.view_of(room))).collect();
        if views.is_empty() {
            let rooms: Vec<&str> = house.rooms.iter().map(|room| room.label.as_str()).collect();
            let (room, rooms) = (self.room.as_deref().unwrap_or_default(), rooms.join(", "));
            return Err(
                UsageError(format!("no room is called {room:?}; there are: {rooms}")).into()
            );
        }
        Ok(views)
    }

    fn given_pose(&self) -> anyhow::Result<Option<Isometry3<f64>>> {
        let finite = self.pose.iter().chain(&self.at).all(|it| it.is_finite());
        let pose = match (self.pose.as_slice(), self.at.as_slice()) {
            ([], []) => return Ok(None),
            _ if !finite => None,
            ([x, y, z], []) => Some(looking_along(Point3::new(*x, *y, *z), 0.0, 0.0)),
            ([x, y, z, yaw, pitch], []) => {
                let eye = Point3::new(*x, *y, *z);
                Some(looking_along(eye, yaw.to_radians(), pitch.to_radians()))
            }
            ([x, y, z], [to_x, to_y, to_z]) => {
                Some(looking_at(Point3::new(*x, *y, *z), Point3::new(*to_x, *to_y, *to_z)))
            }
            _ => None,
        };
        let problem = "--pose must be x,y,z or x,y,z,yaw,pitch, and --at x,y,z with a --pose of \
                       three numbers";
        pose.map(Some).ok_or_else(|| UsageError(problem.to_owned()).into())
    }

    /// Where colour, depth and mask of a view go.
    fn files(&self, view: &str, views: usize) -> anyhow::Result<[PathBuf; 3]> {
        let is_file = self.out.extension().is_some_and(|it| it.eq_ignore_ascii_case("png"));
        let (folder, stem) = if is_file {
            if views > 1 {
                let problem = "several pictures need a folder: give --out one, or choose a --room";
                return Err(UsageError(problem.to_owned()).into());
            }
            let stem = self.out.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            (self.out.parent().unwrap_or(Path::new("")), stem)
        } else {
            (self.out.as_path(), file_name(view))
        };
        let beside = |part: &str| folder.join(format!("{stem}-{part}.png"));
        let colour = if is_file { self.out.clone() } else { beside("colour") };
        Ok([colour, beside("depth"), beside("mask")])
    }

    fn save(
        &self,
        files: &[PathBuf; 3],
        frame: &Frame,
        camera: &Camera,
        number: u64,
    ) -> anyhow::Result<()> {
        let (colour, depth_mm) = match self.noise {
            None => (frame.colour.clone(), frame.depth_mm()),
            Some(seed) => {
                let picture = Picture::take(frame, camera, &NoiseConfig::default(), seed, number);
                (picture.colour, picture.depth_mm)
            }
        };
        let pictures = [colour, depth_colours(&depth_mm), frame.mask_colours()];
        for (path, colours) in files.iter().zip(&pictures) {
            let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
            if let Some(folder) = folder {
                fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
            }
            let file = png(frame.width, frame.height, colours)?;
            fs::write(path, file).with_context(|| path.display().to_string())?;
        }
        Ok(())
    }
}

fn same(a: &str, b: &str) -> bool {
    file_name(a) == file_name(b)
}

/// A label as people type it and file systems take it.
fn file_name(label: &str) -> String {
    label.to_lowercase().chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect()
}

fn size(text: &str) -> Result<(u32, u32), String> {
    let problem = || format!("{text:?} is no size: it must be like 640x480");
    let (width, height) = text.split_once('x').ok_or_else(problem)?;
    let parse = |part: &str| part.parse::<u32>().map_err(|_| problem());
    let (width, height) = (parse(width)?, parse(height)?);
    let pixels = u64::from(width) * u64::from(height);
    if pixels == 0 || pixels > PIXELS_MAX {
        return Err(format!("{text} has {pixels} pixels: it must be from 1 to {PIXELS_MAX}"));
    }
    Ok((width, height))
}

fn things_in(house: &House, frame: &Frame) -> Vec<String> {
    let mut seen = frame.mask.clone();
    seen.sort_unstable();
    seen.dedup();
    let things = seen.iter().filter_map(|mask| house.things.get(usize::from(mask.checked_sub(1)?)));
    things.map(|thing| thing.label.as_str().to_owned()).collect()
}

fn print(document: &RenderDocument, out: &mut Output) -> anyhow::Result<()> {
    for picture in &document.pictures {
        let things = picture.things.len();
        let [x, y, z] = picture.position;
        writeln!(
            out,
            "{} (from {x:.2}, {y:.2}, {z:.2}; {things} things): {}",
            plain(&picture.view),
            picture.colour.display()
        )?;
    }
    Ok(())
}
