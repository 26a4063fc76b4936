//! Regular morphology of English: plurals and verb forms, with the irregular plurals of the house.

/// A form of a verb.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    Base,
    /// "moves".
    Present,
    /// "moved".
    Past,
    /// "(has) moved".
    Participle,
    /// "moving".
    Gerund,
}

const IRREGULAR: [(&str, &str); 30] = [
    ("knives", "knife"),
    ("shelves", "shelf"),
    ("loaves", "loaf"),
    ("halves", "half"),
    ("leaves", "leaf"),
    ("scarves", "scarf"),
    ("men", "man"),
    ("women", "woman"),
    ("children", "child"),
    ("people", "person"),
    ("mice", "mouse"),
    ("feet", "foot"),
    ("teeth", "tooth"),
    ("geese", "goose"),
    ("dice", "die"),
    ("wives", "wife"),
    ("fungi", "fungus"),
    ("cookies", "cookie"),
    ("movies", "movie"),
    ("ties", "tie"),
    ("pies", "pie"),
    ("shoes", "shoe"),
    ("cacti", "cactus"),
    ("hoodies", "hoodie"),
    ("zombies", "zombie"),
    ("brownies", "brownie"),
    ("selfies", "selfie"),
    ("smoothies", "smoothie"),
    ("canoes", "canoe"),
    ("axes", "axe"),
];

/// Singular words that end in s.
const SINGULAR: [&str; 26] = [
    "glass", "dress", "bus", "gas", "mattress", "canvas", "lens", "cactus", "compass", "brass",
    "chess", "christmas", "cross", "grass", "always", "this", "his", "its", "is", "was", "us",
    "yes", "plus", "less", "ours", "tennis",
];

/// Whether a noun has the form of a plural.
pub(super) fn is_plural(word: &str) -> bool {
    singular(word) != word
}

/// The singular of a noun; a noun that has none stays as it is.
pub(super) fn singular(word: &str) -> String {
    if let Some((_, one)) = IRREGULAR.iter().find(|(many, _)| *many == word) {
        return (*one).to_owned();
    }
    let kept = word.len() < 4 && !matches!(word, "cds" | "tvs" | "pcs");
    if kept || SINGULAR.contains(&word) || !word.ends_with('s') {
        return word.to_owned();
    }
    let cut = |n: usize| &word[..word.len() - n];
    if word.ends_with("ss") || word.ends_with("us") || word.ends_with("is") {
        word.to_owned()
    } else if word.ends_with("ies") {
        cut(3).to_owned() + "y"
    } else if ["sses", "ches", "shes", "xes", "zzes", "toes", "buses"].iter().any(|end| word.ends_with(end)) {
        cut(2).to_owned()
    } else {
        cut(1).to_owned()
    }
}

fn is_vowel(letter: u8) -> bool {
    matches!(letter, b'a' | b'e' | b'i' | b'o' | b'u')
}

/// Whether the last consonant is doubled before "-ed" and "-ing": "drop", not "open".
fn doubles(word: &str) -> bool {
    let [.., a, b, c] = word.as_bytes() else { return false };
    let one_syllable = word.bytes().filter(|letter| is_vowel(*letter)).count() == 1;
    one_syllable && !is_vowel(*a) && is_vowel(*b) && !is_vowel(*c) && !matches!(c, b'w' | b'x' | b'y')
}

fn with_ending(word: &str, ending: &str) -> String {
    match word.chars().last() {
        Some(last) if doubles(word) => format!("{word}{last}{ending}"),
        _ => format!("{word}{ending}"),
    }
}

/// "move" → "moved".
pub(super) fn past(base: &str) -> String {
    match base.as_bytes() {
        [.., b'e'] => format!("{base}d"),
        [.., a, b'y'] if !is_vowel(*a) => format!("{}ied", &base[..base.len() - 1]),
        _ => with_ending(base, "ed"),
    }
}

/// "move" → "moving".
pub(super) fn gerund(base: &str) -> String {
    match base.as_bytes() {
        [.., a, b'e'] if *a != b'e' && *a != b'o' => format!("{}ing", &base[..base.len() - 1]),
        _ => with_ending(base, "ing"),
    }
}

/// "move" → "moves".
pub(super) fn third_person(base: &str) -> String {
    match base.as_bytes() {
        [.., a, b'y'] if !is_vowel(*a) => format!("{}ies", &base[..base.len() - 1]),
        [.., b's' | b'x' | b'z' | b'o'] | [.., b'c' | b's', b'h'] => format!("{base}es"),
        _ => format!("{base}s"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plurals_become_singular_and_singulars_stay() {
        for (many, one) in [
            ("mugs", "mug"), ("boxes", "box"), ("dishes", "dish"), ("knives", "knife"),
            ("batteries", "battery"), ("glass", "glass"), ("glasses", "glass"), ("bus", "bus"),
            ("tomatoes", "tomato"), ("vases", "vase"), ("houses", "house"), ("cds", "cd"), ("keys", "key"),
            ("couches", "couch"), ("leaves", "leaf"), ("tennis", "tennis"), ("shelves", "shelf"),
        ] {
            assert_eq!(singular(many), one);
        }
    }

    #[test]
    fn verbs_take_their_endings() {
        let forms = |base| (past(base), gerund(base), third_person(base));
        let text = |a: &str, b: &str, c: &str| (a.to_owned(), b.to_owned(), c.to_owned());
        assert_eq!(forms("move"), text("moved", "moving", "moves"));
        assert_eq!(forms("carry"), text("carried", "carrying", "carries"));
        assert_eq!(forms("drop"), text("dropped", "dropping", "drops"));
        assert_eq!(forms("push"), text("pushed", "pushing", "pushes"));
        assert_eq!(forms("place"), text("placed", "placing", "places"));
    }
}
