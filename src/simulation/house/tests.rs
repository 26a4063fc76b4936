//! Houses, right and wrong.

use super::*;

#[test]
fn the_built_in_houses_are_possible() {
    let mut wrong = String::new();
    for it in BUILT_IN {
        match it.house() {
            Ok(house) => assert_eq!(house.name, it.name),
            Err(errors) => {
                errors.iter().for_each(|error| wrong += &format!("{}: {error}\n", it.name));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}
