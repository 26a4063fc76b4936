//! Any text as what a person types: points in time, spans, conditions, nodes, lines of input.
#![no_main]

use libfuzzer_sys::fuzz_target;
use scenefold::history::{Expr, Selector};
use scenefold::interchange::lines;
use scenefold::time::{At, Span, Stamp};

fuzz_target!(|text: &str| {
    if let Ok(at) = text.parse::<At>() {
        assert_eq!(at.to_string().parse::<At>().is_ok(), true, "{at}");
    }
    let _ = (text.parse::<Span>(), text.parse::<Stamp>());
    if let Ok(expr) = text.parse::<Expr>() {
        let _ = format!("{expr:?}");
    }
    let _ = text.parse::<Selector>();
    let _ = lines::parse(text);
});
