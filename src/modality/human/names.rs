//! Names of things: when do two of them mean the same?

use std::collections::{BTreeMap, BTreeSet};

use super::lemma::singular;

/// A name as words: lower case, singular, whatever the spelling ("DiningTable|1", "dining_tables").
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Name {
    /// The words.
    pub words: Vec<String>,
    /// The words in one, so that "bath tub" is "bathtub".
    pub key: String,
}

impl Name {
    /// The name that a label or words of a sentence spell.
    pub fn new(text: &str) -> Self {
        Self::of(spelled(text).iter().map(|word| singular(word)).collect())
    }

    pub fn of(words: Vec<String>) -> Self {
        let key = words.concat();
        Self { words, key }
    }

    fn suffix(&self, from: usize) -> String {
        self.words[from..].concat()
    }
}

/// The words of a label: split at blanks, `_`, `-`, `|` and inner capitals; numbers left out.
fn spelled(text: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut before: Option<char> = None;
    let mut chars = text.chars().peekable();
    while let Some(c) = chars.next() {
        let hump = c.is_uppercase()
            && (before.is_some_and(|b| b.is_lowercase() || b.is_ascii_digit())
                || (before.is_some_and(char::is_uppercase)
                    && chars.peek().is_some_and(|next| next.is_lowercase())));
        if hump {
            words.push(String::new());
        }
        if c.is_alphabetic() {
            words.last_mut().expect("it is never empty").extend(c.to_lowercase());
        } else if c != '\'' && c != '\u{2019}' {
            words.push(String::new());
        }
        before = Some(c);
    }
    words.retain(|word| !word.is_empty());
    // A possessive: "kid's room".
    let last = words.len().saturating_sub(1);
    let mut at = 0;
    words.retain(|word| {
        at += 1;
        word != "s" || at - 1 == last
    });
    words
}

/// How closely a mention and a label agree; less is closer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Closeness {
    /// The same words, in whatever spelling or number.
    Same,
    /// Words that mean the same.
    Synonym,
    /// What people who say just this often mean, the most usual first; for tasks only.
    Typical(usize),
    /// The same head: "remote" and "tv remote"; how many words of the mention are left out.
    Compound(usize),
    /// One is a kind of the other: "fruit" and "apple".
    Kind,
    /// Part of it, or what it holds: "toilet tank", "apple slice".
    Part,
    /// What the head of it is often used for; for tasks only.
    Often(usize),
}

impl Closeness {
    /// Words for people.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Same => "the same words",
            Self::Synonym => "a synonym",
            Self::Compound(_) => "the same head of a compound",
            Self::Kind => "a kind of it",
            Self::Part => "a part of it",
            Self::Typical(_) | Self::Often(_) => "what is often meant by it",
        }
    }
}

/// Endings that stand for a thing of their own within one word: "bookshelf" is a shelf.
const HEADS: [&str; 15] = [
    "shelf", "chair", "tub", "box", "bag", "brush", "top", "room", "stand", "ball", "bin", "basket",
    "case", "cabinet", "bottle",
];

/// Which names mean the same.
#[derive(Debug)]
pub(super) struct Names {
    groups: BTreeMap<String, Vec<usize>>,
    kinds: BTreeMap<String, BTreeSet<String>>,
    typical: BTreeMap<String, Vec<String>>,
}

impl Names {
    pub fn new(
        synonyms: &[Vec<String>],
        kinds: &BTreeMap<String, Vec<String>>,
        typical: &BTreeMap<String, Vec<String>>,
    ) -> Self {
        let key = |text: &String| Name::new(text).key;
        let mut groups: BTreeMap<String, Vec<usize>> = BTreeMap::new();
        for (n, group) in synonyms.iter().enumerate() {
            for name in group {
                let of = groups.entry(key(name)).or_default();
                if of.last() != Some(&n) {
                    of.push(n);
                }
            }
        }
        let kinds = kinds.iter().map(|(kind, of)| (key(kind), of.iter().map(key).collect())).collect();
        let typical = typical.iter().map(|(name, of)| (key(name), of.iter().map(key).collect())).collect();
        Self { groups, kinds, typical }
    }

    /// Whether two keys are equal or stand in one group.
    fn alike(&self, a: &str, b: &str) -> bool {
        a == b || self.share_group(a, b)
    }

    fn share_group(&self, a: &str, b: &str) -> bool {
        let (Some(a), Some(b)) = (self.groups.get(a), self.groups.get(b)) else { return false };
        a.iter().any(|group| b.contains(group))
    }

    /// Whether the lexicon knows the name at all.
    pub fn knows(&self, name: &Name) -> bool {
        self.groups.contains_key(&name.key) || self.kinds.contains_key(&name.key)
    }

    /// How closely `mention` agrees with `label`, both without adjectives.
    pub fn compare(&self, mention: &Name, label: &Name) -> Option<Closeness> {
        if mention.words.is_empty() || label.words.is_empty() {
            return None;
        }
        if mention.key == label.key {
            return Some(Closeness::Same);
        }
        if self.share_group(&mention.key, &label.key) {
            return Some(Closeness::Synonym);
        }
        if let Some(dropped) = self.compound(mention, label) {
            return Some(Closeness::Compound(dropped));
        }
        self.kind(mention, label).then_some(Closeness::Kind)
    }

    /// One of the two is the other with words before it.
    fn compound(&self, mention: &Name, label: &Name) -> Option<usize> {
        let in_label = (1..label.words.len()).any(|n| self.alike(&mention.key, &label.suffix(n)));
        let head = |of: &Name, in_: &Name| {
            HEADS.contains(&of.key.as_str()) && in_.words.len() == 1 && in_.key.ends_with(&of.key)
        };
        if in_label || head(mention, label) {
            return Some(0);
        }
        let dropped = (1..mention.words.len()).find(|n| self.alike(&mention.suffix(*n), &label.key));
        dropped.or_else(|| head(label, mention).then_some(1))
    }

    fn kind(&self, mention: &Name, label: &Name) -> bool {
        let within = |kind: &Name, of: &Name| {
            let last = of.words.len() - 1;
            let members = self.kinds.get(&kind.key);
            members.is_some_and(|members| members.contains(&of.key) || members.contains(&of.words[last]))
        };
        within(mention, label) || within(label, mention)
    }

    /// Where `label` stands among what people often mean by exactly `mention`.
    pub fn typical(&self, mention: &Name, label: &Name) -> Option<usize> {
        self.usual(&mention.key, label)
    }

    /// The same for the head of `mention`, with as many words before it as are known.
    pub fn often(&self, mention: &Name, label: &Name) -> Option<usize> {
        (1..mention.words.len()).find_map(|n| self.usual(&mention.suffix(n), label))
    }

    fn usual(&self, key: &str, label: &Name) -> Option<usize> {
        let of = self.typical.get(key)?;
        of.iter().position(|class| self.alike(class, &label.key) || label.key.ends_with(class.as_str()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modality::human::lexicon::lexicon;

    #[track_caller]
    fn check(mention: &str, label: &str, closeness: Option<Closeness>) {
        let names = &lexicon().names;
        assert_eq!(names.compare(&Name::new(mention), &Name::new(label)), closeness, "{mention} {label}");
    }

    #[test]
    fn spellings_of_a_label_are_one_name() {
        for text in ["DiningTable", "dining_table", "Dining Tables", "DiningTable|1", "dining-table_02"] {
            assert_eq!(Name::new(text).words, ["dining", "table"], "{text}");
        }
        assert_eq!(Name::new("TVStand").words, ["tv", "stand"]);
        assert_eq!(Name::new("CD").words, ["cd"]);
    }

    #[test]
    fn names_agree_as_people_use_them() {
        check("bath tub", "Bathtub", Some(Closeness::Same));
        check("couch", "sofa", Some(Closeness::Synonym));
        check("tv remote", "RemoteControl", Some(Closeness::Synonym));
        check("remote", "tv_remote", Some(Closeness::Synonym));
        check("mug", "travel mug", Some(Closeness::Compound(0)));
        check("birthday mug", "mug", Some(Closeness::Compound(1)));
        check("shelf", "bookshelf", Some(Closeness::Synonym));
        check("fruit", "apple", Some(Closeness::Kind));
        check("coffee table", "dining table", None);
        check("apple", "pineapple", None);
        check("mug", "plate", None);
    }
}
