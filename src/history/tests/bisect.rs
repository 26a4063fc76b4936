//! Conditions: how they read, and when they first hold.

use insta::assert_snapshot;
use proptest::prelude::*;

use super::arbitrary;
use super::fixture::{journey, log};
use crate::change::World;
use crate::event::Logged;
use crate::history::{BisectDocument, Expr, Slice, advance, first_holding};

#[track_caller]
fn check_parse(text: &str, expected: &str) {
    let expr: Expr = text.parse().unwrap();
    assert_eq!(expr.to_string(), expected, "{text}");
    assert_eq!(expr.to_string().parse(), Ok(expr), "{expected}");
}

#[test]
fn conditions_are_read() {
    check_parse("absent(mug)", r#"absent("mug")"#);
    check_parse(" PRESENT ( O17 ) ", "present(O17)");
    check_parse("in(tv remote, living room)", r#"in("tv remote", "living room")"#);
    check_parse(r#"on("salt, fine", O3)"#, r#"on("salt, fine", O3)"#);
    check_parse("count(mug)>=2", r#"count("mug") >= 2"#);
    check_parse("probability(O4) < 0.25", "probability(O4) < 0.25");
    check_parse("rooms!=3", "rooms != 3");
    check_parse("changes == 7", "changes = 7");
    check_parse("not not held(O1)", "held(O1)");
    check_parse("held(O1) or held(O2) and ! held(O3)", "(held(O1) or (held(O2) and not held(O3)))");
    check_parse("(held(O1) || held(O2)) && held(O3)", "((held(O1) or held(O2)) and held(O3))");
    check_parse("held(order)or held(not here)", r#"(held("order") or held("not here"))"#);
}

fn problem(text: &str) -> String {
    text.parse::<Expr>().unwrap_err().to_string()
}

#[test]
fn what_is_no_condition_is_refused_with_the_column() {
    let texts = [
        "",
        "absnt(mug)",
        "gone(mug)",
        "absent mug",
        "absent()",
        "absent(mug",
        "absent(R2)",
        "in(mug)",
        "in(mug, O3)",
        "in(mug, kitchen",
        "count(mug)",
        "count(mug) > many",
        "count(mug) > 1.2.3",
        "present(mug) present(cup)",
        "present(mug) and",
        "(present(mug)",
        r#"present("mug)"#,
        "présent(mug)",
    ];
    let lines: Vec<String> =
        texts.iter().map(|text| format!("{text}: {}", problem(text))).collect();
    assert_snapshot!(lines.join("\n"), @r#"
    : column 1 of the condition: expected a test such as absent(mug), or `(`, but the condition ends
    absnt(mug): column 1 of the condition: there is no test `absnt`; did you mean `absent`?
    gone(mug): column 1 of the condition: there is no test `gone`; the tests are present, absent, held, in, on, count, probability, objects, rooms, changes
    absent mug: column 8 of the condition: expected `(`, but 'm' comes
    absent(): column 8 of the condition: expected an object's id or label, but ')' comes
    absent(mug: column 11 of the condition: expected `)`, but the condition ends
    absent(R2): column 8 of the condition: expected an object, but R2 is a room
    in(mug): column 7 of the condition: expected `,`, but ')' comes
    in(mug, O3): column 8 of the condition: expected a room, but O3 is an object: use on(…)
    in(mug, kitchen: column 16 of the condition: expected `)`, but the condition ends
    count(mug): column 11 of the condition: expected a comparison (<, <=, >, >=, = or !=), but the condition ends
    count(mug) > many: column 14 of the condition: expected a number such as 3 or 0.5, but 'm' comes
    count(mug) > 1.2.3: column 14 of the condition: expected a number such as 3 or 0.5, but '1' comes
    present(mug) present(cup): column 14 of the condition: expected `and`, `or` or the end, but 'p' comes
    present(mug) and: column 17 of the condition: expected a test such as absent(mug), or `(`, but the condition ends
    (present(mug): column 14 of the condition: expected `and`, `or` or `)`, but the condition ends
    present("mug): column 9 of the condition: the quote is not closed
    présent(mug): column 1 of the condition: there is no test `présent`; did you mean `present`?
    "#);
}

#[test]
fn nesting_is_bounded() {
    let nested = |depth: usize| format!("{}held(O1){}", "(".repeat(depth), ")".repeat(depth));
    assert!(nested(64).parse::<Expr>().is_ok());
    assert_snapshot!(problem(&nested(100_000)), @"column 65 of the condition: parentheses are nested deeper than 64");
    let negated = "!".repeat(100_000) + "held(O1)";
    assert!(negated.parse::<Expr>().is_ok());
}

/// A mug is put on the table, then a bowl of cereal on the bed, then a mug is taken.
fn morning() -> Vec<Logged> {
    log("480 t1 picked O4
         485 t1 placed O4 on table in kitchen
         490 t2 picked bowl
         495 t2 placed bowl on bed
         500 t3 picked O5
         510 t4 placed spoon on bed
         600 tick
         900 tick")
}

/// The first event after which each condition holds, with its change.
fn answers(log: &[Logged], conditions: &[&str]) -> String {
    let answer = |condition: &&str| {
        let hit = first_holding(&Slice(log), &condition.parse().unwrap()).unwrap();
        let change = |seq| format!(" c{seq}");
        let words = hit.as_ref().map_or("never".to_owned(), |hit| {
            let topic = log[hit.order as usize - 1].event.topic().name();
            format!("#{} {topic}{}", hit.order, hit.change.map_or(String::new(), change))
        });
        format!("{condition}: {words}")
    };
    conditions.iter().map(answer).collect::<Vec<_>>().join("\n")
}

#[test]
fn the_first_event_is_found() {
    let conditions = [
        "present(mug)",
        "absent(mug)",
        "absent(mug) and not present(mug)",
        "count(mug) = 0",
        "count(mug) < 2",
        "held(cereal)",
        "held(O5)",
        "in(mug, kitchen)",
        "in(cereal, bedroom)",
        "in(cereal, R2) && not held(O5)",
        "on(mug, table)",
        "on(O4, cupboard)",
        "on(spoon, bed)",
        "present(spoon)",
        "absent(spoon)",
        "objects > 8",
        "rooms >= 3",
        "rooms = 2",
        "changes >= 3",
        "probability(tv remote) < 0.5",
        "probability(O4) < 0.1",
        "present(zebra) or held(tv_remote)",
    ];
    assert_snapshot!(answers(&morning(), &conditions), @r"
    present(mug): #1 /graph/initial
    absent(mug): #4 /primitive c1
    absent(mug) and not present(mug): never
    count(mug) = 0: never
    count(mug) < 2: #4 /primitive c1
    held(cereal): #10 /primitive c3
    held(O5): #16 /primitive c5
    in(mug, kitchen): #1 /graph/initial
    in(cereal, bedroom): #13 /primitive c4
    in(cereal, R2) && not held(O5): #13 /primitive c4
    on(mug, table): #7 /primitive c2
    on(O4, cupboard): #1 /graph/initial
    on(spoon, bed): #19 /primitive c6
    present(spoon): #19 /primitive c6
    absent(spoon): never
    objects > 8: #19 /primitive c6
    rooms >= 3: never
    rooms = 2: #1 /graph/initial
    changes >= 3: #9 /change c3
    probability(tv remote) < 0.5: #2 /robot/task_status
    probability(O4) < 0.1: never
    present(zebra) or held(tv_remote): never
    ");
}

#[test]
fn an_answer_has_a_document() {
    let log = morning();
    let document = |condition: &str| {
        let hit = first_holding(&Slice(&log), &condition.parse().unwrap()).unwrap();
        serde_json::to_string(&BisectDocument::of(hit.as_ref())).unwrap()
    };
    assert_snapshot!(document("held(O5)"), @r#"{"order":16,"at":"2026-01-05T08:20:00Z","change":5}"#);
    assert_snapshot!(document("held(zebra)"), @r#"{"order":null,"at":null,"change":null}"#);
}

/// The first event, by looking at the whole world after each.
fn first_by_looking(log: &[Logged], expr: &Expr) -> Option<u64> {
    let mut world = World::default();
    let mut holds = |logged: &&Logged| {
        advance(&mut world, logged).unwrap();
        expr.holds(&world, logged.at, 0)
    };
    log.iter().find(&mut holds).map(|logged| logged.order)
}

const CONDITIONS: [&str; 14] = [
    "absent(mug)",
    "held(tv remote)",
    "present(table) and absent(table)",
    "in(mug, R1)",
    "in(mug, tv remote)",
    "in(O3, house)",
    "on(mug, table)",
    "on(O1, O2) or on(O2, O1)",
    "count(mug) > 2",
    "not present(mug)",
    "objects = 3",
    "rooms < 2",
    "probability(mug) < 0.1",
    "probability(table) = 1 and not held(O4)",
];

proptest! {
    #[test]
    fn watching_changes_gives_the_answer_of_looking_at_everything(
        graphs in prop::collection::vec(arbitrary::graph(), 1..4),
        (a, b) in arbitrary::two_in_one_house(),
    ) {
        for log in [journey(&graphs), journey(&[a, b])] {
            for condition in CONDITIONS {
                let expr: Expr = condition.parse().unwrap();
                let hit = first_holding(&Slice(&log), &expr).unwrap();
                let (order, looked) = (hit.map(|hit| hit.order), first_by_looking(&log, &expr));
                prop_assert_eq!(order, looked, "{}", condition);
            }
        }
    }

    #[test]
    fn any_text_is_read_or_refused_without_panic(text in ".{0,40}") {
        let _ = text.parse::<Expr>();
    }

    #[test]
    fn any_mixture_of_words_is_read_or_refused_without_panic(
        words in prop::collection::vec(
            prop::sample::select(vec![
                "(", ")", "not", "!", "and", "or", "in", "count", "held", "mug", "O1", "R1", ",",
                "<", "=", "0.5", "\"", " ", "objects",
            ]),
            0..20,
        )
    ) {
        if let Ok(expr) = words.concat().parse::<Expr>() {
            prop_assert_eq!(expr.to_string().parse(), Ok(expr));
        }
    }
}
