//! `scenefold house`

use std::io::Write;

use serde::Serialize;

use super::output::{Output, Style};
use super::{Outcome, UsageError};
use crate::simulation::house::{BUILT_IN, BuiltIn, House as Model, Loaded, load_reported};

/// Check and describe a house: a file, or one that is built in
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  scenefold house                            the built-in houses
  scenefold house apartment                  what is in one
  scenefold house my_house.json              is it possible? errors name the field
  scenefold house apartment --print > my_house.json    a house to start from
Also takes the graph of a VirtualHome apartment, or a scene.")]
pub struct House {
    /// Name of a built-in house, or a file (JSON)
    #[arg(value_name = "HOUSE")]
    name: Option<String>,
    /// Print the file of a built-in house
    #[arg(long, conflicts_with = "json")]
    print: bool,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
}

/// A house in numbers.
#[derive(Debug, Serialize)]
struct Summary {
    name: String,
    rooms: Vec<RoomSummary>,
    doors: usize,
    objects: usize,
    classes: usize,
    movable: usize,
    triangles: usize,
    notes: Vec<String>,
}

#[derive(Debug, Serialize)]
struct RoomSummary {
    label: String,
    square_metres: f64,
    opens_to: Vec<String>,
    objects: usize,
}

/// Runs `scenefold house`.
pub fn run(args: &House, out: &mut Output) -> anyhow::Result<Outcome> {
    let Some(name) = &args.name else { return list(args, out) };
    if args.print {
        let known = BuiltIn::named(name);
        let known = known.ok_or_else(|| {
            UsageError(format!("--print {name}: there is no built-in house of this name"))
        })?;
        write!(out, "{}", known.json)?;
        return Ok(Outcome::Clean);
    }
    let summary = summary(&load_reported(name)?);
    if args.json {
        out.json(&summary)?;
    } else {
        print(&summary, out)?;
    }
    Ok(if summary.notes.is_empty() { Outcome::Clean } else { Outcome::Findings })
}

fn list(args: &House, out: &mut Output) -> anyhow::Result<Outcome> {
    if args.print {
        return Err(UsageError("--print needs the name of a built-in house".to_owned()).into());
    }
    if args.json {
        let all: Vec<_> =
            BUILT_IN.iter().map(|it| Listed { name: it.name, about: it.about }).collect();
        out.json(&all)?;
        return Ok(Outcome::Clean);
    }
    for house in BUILT_IN {
        writeln!(out, "{:12} {}", out.paint(Style::Bold, house.name), house.about)?;
    }
    Ok(Outcome::Clean)
}

#[derive(Debug, Serialize)]
struct Listed {
    name: &'static str,
    about: &'static str,
}

fn summary(Loaded { house, notes }: &Loaded) -> Summary {
    let rooms = (0..house.rooms.len()).map(|n| room(house, n)).collect();
    let mut classes: Vec<&str> = house.things.iter().map(|it| it.label.as_str()).collect();
    classes.sort_unstable();
    classes.dedup();
    Summary {
        name: house.name.clone(),
        rooms,
        doors: house.doors.len(),
        objects: house.things.len(),
        classes: classes.len(),
        movable: house.things.iter().filter(|it| it.movable).count(),
        triangles: house.triangles(),
        notes: notes.clone(),
    }
}

fn room(house: &Model, n: usize) -> RoomSummary {
    let others = house.doors.iter().filter(|door| door.rooms.contains(&n));
    let other = |rooms: [usize; 2]| if rooms[0] == n { rooms[1] } else { rooms[0] };
    RoomSummary {
        label: house.rooms[n].label.to_string(),
        square_metres: (house.rooms[n].area_m2() * 100.0).round() / 100.0,
        opens_to: others.map(|door| house.rooms[other(door.rooms)].label.to_string()).collect(),
        objects: house.things.iter().filter(|thing| thing.room == n).count(),
    }
}

fn print(it: &Summary, out: &mut Output) -> anyhow::Result<()> {
    let name = out.paint(Style::Bold, &it.name);
    writeln!(
        out,
        "{name}: {} rooms, {} doors, {} objects of {} classes ({} movable), {} triangles",
        it.rooms.len(),
        it.doors,
        it.objects,
        it.classes,
        it.movable,
        it.triangles
    )?;
    for room in &it.rooms {
        let doors = match room.opens_to.is_empty() {
            true => "no door".to_owned(),
            false => format!("opens to {}", room.opens_to.join(", ")),
        };
        writeln!(
            out,
            "  {:14} {:5.1} m2  {:3} objects  {doors}",
            room.label, room.square_metres, room.objects
        )?;
    }
    for note in &it.notes {
        writeln!(out, "  note: {note}")?;
    }
    Ok(())
}
