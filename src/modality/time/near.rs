//! Which known class is nearest to a label that is not known.

/// The words of a label in lower case: `Coffee_mug` → `coffee`, `mug`.
fn words(label: &str) -> Vec<String> {
    let lower = label.to_lowercase();
    lower.split(|c: char| !c.is_alphanumeric()).filter(|w| !w.is_empty()).map(Into::into).collect()
}

/// Edit distance of two words (Levenshtein), in characters.
fn edits(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut corner = std::mem::replace(&mut row[0], i + 1);
        for (j, y) in b.iter().enumerate() {
            let changed = corner + usize::from(x != *y);
            let least = changed.min(row[j] + 1).min(row[j + 1] + 1);
            corner = std::mem::replace(&mut row[j + 1], least);
        }
    }
    row[b.len()]
}

/// The nearest of `known` to `label`, with how it is near. In this order: the same last word,
/// which in English is the noun ("coffee mug" is a "mug"); another word in common, the longest;
/// one word misspelt by at most a quarter of its letters. Among equals the first in the alphabet.
pub(super) fn nearest<'k>(
    label: &str,
    known: impl Iterator<Item = &'k str>,
) -> Option<(&'k str, &'static str)> {
    let wanted = words(label);
    let last = wanted.last()?;
    let score = |class: &'k str| {
        let have = words(class);
        if have.last() == Some(last) {
            return Some((3, 1000 - have.len().abs_diff(wanted.len()), class, "same noun"));
        }
        let shared = wanted.iter().filter(|word| word.chars().count() > 2 && have.contains(word));
        if let Some(longest) = shared.map(|word| word.chars().count()).max() {
            return Some((2, longest, class, "a word in common"));
        }
        let (ours, theirs) = (wanted.concat(), have.concat());
        let letters = ours.chars().count().max(theirs.chars().count());
        let wrong = edits(&ours, &theirs);
        (wrong * 4 <= letters).then(|| (1, 1000 - wrong.min(1000), class, "spelt alike"))
    };
    let best = known.filter_map(score).max_by(|a, b| {
        (a.0, a.1).cmp(&(b.0, b.1)).then_with(|| b.2.cmp(a.2))
    });
    best.map(|(_, _, class, how)| (class, how))
}

#[cfg(test)]
mod tests {
    use super::*;

    const KNOWN: [&str; 6] = ["book", "cup", "mug", "remote control", "shopping bag", "wine glass"];

    #[track_caller]
    fn check(label: &str, expected: Option<(&str, &str)>) {
        assert_eq!(nearest(label, KNOWN.into_iter()), expected, "{label}");
    }

    #[test]
    fn a_label_is_near_by_its_noun_a_word_or_its_spelling() {
        check("coffee mug", Some(("mug", "same noun")));
        check("coffee_cup", Some(("cup", "same noun")));
        check("tv remote", Some(("remote control", "a word in common")));
        check("paper bag", Some(("shopping bag", "same noun")));
        check("wineglass", Some(("wine glass", "spelt alike")));
        check("boook", Some(("book", "spelt alike")));
        check("refrigerator", None);
        check("", None);
    }

    #[test]
    fn edits_are_counted_as_levenshtein_did() {
        for (a, b, n) in [("", "", 0), ("kitten", "sitting", 3), ("mug", "", 3), ("ab", "ba", 2)] {
            assert_eq!((edits(a, b), edits(b, a)), (n, n), "{a} {b}");
        }
    }
}
