//! `scenefold why`

use std::io::Write;
use std::path::PathBuf;

use anyhow::Context;

use super::output::Output;
use super::progress::Counted;
use super::source::{self, RecordingArg};
use super::{Outcome, UsageError};
use crate::event::Event;
use crate::history::{Selector, Why as Life, WhyDocument, WhyError, why};
use crate::time::At;

/// Why the robot believes what it does of an object: back to the messages that caused it
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  scenefold why day.mcap mug                      where the mug is and how it got there
  scenefold why day.mcap O17 --at 36h             what was known of it after a day and a half
  scenefold why day.mcap banana --json            also of what is not there any more")]
pub struct Why {
    #[command(flatten)]
    recording: RecordingArg,
    /// The object: an id (O17) or a label
    object: String,
    /// Up to this point: start, end, 12.5s, 36h, 65d, an RFC 3339 instant, #42, c7 or nanoseconds
    #[arg(long, value_name = "AT", default_value = "end")]
    at: At,
    /// Also save the pictures among the evidence here
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
}

/// Runs `scenefold why`.
pub fn run(args: &Why, out: &mut Output) -> anyhow::Result<Outcome> {
    let recording = source::open(&args.recording.path)?;
    let upto = recording.state_at(args.at, source::threads())?.order;
    let Ok(who) = args.object.parse::<Selector>();
    let life = match why(&Counted::new(&recording), upto, &who) {
        Ok(life) => life,
        // Which object is meant is for the user to say.
        Err(error @ WhyError::Ambiguous { .. }) => return Err(UsageError(error.to_string()).into()),
        Err(error) => return Err(error.into()),
    };
    if args.json {
        out.json(&WhyDocument::of(&life))?;
    } else {
        write!(out, "{life}")?;
    }
    if let Some(folder) = &args.out {
        save_pictures(&life, folder)?;
    }
    Ok(source::warn(&recording))
}

/// Saves every compressed image among the evidence under its event number.
fn save_pictures(life: &Life, folder: &PathBuf) -> anyhow::Result<()> {
    std::fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    for entry in &life.entries {
        for logged in entry.evidence.iter().chain(&entry.inputs) {
            let Event::Sensor(message) = &logged.event else { continue };
            if &*message.schema_name != "sensor_msgs/msg/CompressedImage" {
                continue;
            }
            let image = crate::wire::ros2::decode_compressed_image(&message.data)?;
            let extension = if image.format.contains("png") { "png" } else { "jpg" };
            let path = folder.join(format!("{}.{extension}", logged.order));
            std::fs::write(&path, image.data).with_context(|| path.display().to_string())?;
        }
    }
    Ok(())
}
