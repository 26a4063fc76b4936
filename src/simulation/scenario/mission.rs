//! The mission of the paper's experiment.

use super::Scenario;

/// The paper's mission ("Experiments"): a towel is removed and somebody says so; the robot is to
/// take the mug from the kitchen to the bedroom; the banana is removed, the tv remote moved from
/// the table to the sofa's arm and a book added on the bed, which it has to see by itself.
///
/// Pictures have half the width of those that the noise model was measured on, so a step of
/// disparity is twice as much, and with it steps and noise of depth.
pub fn paper_mission(seed: u64) -> Scenario {
    let text = include_str!("paper_mission.json");
    let scenario = Scenario::from_json(text).expect("the built-in mission is a scenario");
    Scenario { seed, ..scenario }
}
