//! Robot action: what the robot picks and places changes the world (paper, "Robot Action").
//!
//! # What it detects
//! `/robot/task` says what is meant, `/robot/task_status` what happened. *picked*: the object is
//! removed for the time being (held in the gripper), with all that is on or in it. *placed*: it
//! is attached again, with the same id, in the room and on the support named, at the pose given
//! or else topologically.
//!
//! # Evidence
//! The status message, and the message that announced the task.
//!
//! # What keeps the graph true
//! | report | outcome |
//! |---|---|
//! | picked, but no such object is known | rejected; what is in the hand is remembered by its label, and placing it adds a new object |
//! | picked, but several objects answer to the name | rejected with the candidates; placing it is rejected too |
//! | picked, but it had been removed before | rejected; placing it brings the same node back |
//! | picked, but it is in the gripper already | rejected; it stays there, and this task may place it |
//! | placed, but never picked | applied as one move (the robot's own hands are believed), or as an addition if no such object is known |
//! | failed or done with something in the gripper | rejected: it stays in the gripper; a failure that tells where the object was dropped puts it there |
//! | picked or placed by an id and a label that name different things | rejected |
//! | a status of an unknown task that names no object | rejected |
//!
//! # False positives
//! A gripper that reports a pick it did not make. Perception corrects that later.

mod detector;
mod memory;

pub use detector::ActionDetector;

#[cfg(test)]
mod tests;
