//! Tasks that name nothing but their instruction.

use scenefold::event::{Event, Status, Task, TaskStatus};

use super::updater;

#[test]
fn the_parts_of_an_instruction_are_done_in_order() {
    let home = include_str!("../../data/language/family_home.json");
    let mut home = updater(home);
    let at = home.at();
    let instruction =
        "Take the mug to the bedroom, then put the vase on the dining table".to_owned();
    let task = Task { task_id: "t1".to_owned(), instruction, ..Task::default() };
    let logged = home.update(at, Event::Task(task)).unwrap();
    let understood =
        logged.iter().filter(|it| matches!(it.event, Event::Interpretation(_))).count();
    assert_eq!(understood, 2);
    for status in [Status::Picked, Status::Placed, Status::Picked, Status::Placed, Status::Done] {
        let logged = home.update(at, Event::TaskStatus(TaskStatus::bare("t1", status))).unwrap();
        for logged in logged {
            if let Event::Change(record) = logged.event {
                assert!(record.is_applied(), "{:?}", record.outcome);
            }
        }
    }
    let place = |id: &str| {
        let object = home.graph().object(id.parse().unwrap()).unwrap();
        (object.room.to_string(), object.support.map(|on| on.to_string()))
    };
    assert_eq!(place("O10"), ("R2".to_owned(), None));
    assert_eq!(place("O14"), ("R1".to_owned(), Some("O2".to_owned())));
}
