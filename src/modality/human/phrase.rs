//! Noun phrases: determiner, quantity, adjectives, compound, "of", possessor, relative clause.

use super::lemma::{Form, is_plural, singular};
use super::lexicon::{Lexicon, Preposition, VerbForm};
use super::reading::{Mention, Quantity};
use super::token::Token;

/// A noun phrase and what the grammar needs to know of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Phrase {
    pub mention: Mention,
    /// "no milk".
    pub negative: bool,
    /// A pronoun: what it means is told by what came before.
    pub pronoun: bool,
    /// Of somebody of another household: "my neighbour's sofa".
    pub others: bool,
    /// Of "his", "her", "their": somebody spoken of.
    pub theirs: bool,
    /// Spoken of as new: "a new lamp", "another mug".
    pub novel: bool,
    /// Only a part of it: "a slice of the cake".
    pub partial: bool,
    /// Whether the noun has the form of a plural.
    pub plural: bool,
    /// Without any determiner: "keys", "Anna".
    pub bare: bool,
    /// "no more", "any more".
    pub more: bool,
}

/// The words of one sentence, with what the lexicon says of each.
#[derive(Debug)]
pub(super) struct Words<'a> {
    pub lexicon: &'a Lexicon,
    pub tokens: &'a [Token],
    /// Words that belong to an expression of time.
    pub time: Vec<bool>,
}

impl<'a> Words<'a> {
    pub fn word(&self, at: usize) -> &'a str {
        self.tokens.get(at).map_or("", |token| token.text.as_str())
    }

    pub fn is_in(&self, list: &std::collections::BTreeSet<String>, at: usize) -> bool {
        list.contains(self.word(at))
    }

    pub fn is_time(&self, at: usize) -> bool {
        self.time.get(at).copied().unwrap_or(false)
    }

    pub fn verb(&self, at: usize) -> &'a [VerbForm] {
        self.lexicon.forms.get(self.word(at)).map_or(&[], Vec::as_slice)
    }

    pub fn has_form(&self, at: usize, forms: &[Form]) -> bool {
        self.verb(at).iter().any(|it| forms.contains(&it.form))
    }

    /// The preposition that begins here, and its length.
    pub fn preposition(&self, at: usize) -> Option<(usize, Preposition)> {
        if self.is_time(at) {
            return None;
        }
        let of = self.lexicon.prepositions.get(self.word(at))?;
        let fits = |words: &[String]| words.iter().enumerate().all(|(n, word)| self.word(at + n) == word);
        of.iter().find(|(words, _)| fits(words)).map(|(words, role)| (words.len(), *role))
    }

    /// Whether the word can only hold a sentence together.
    fn is_function_word(&self, at: usize) -> bool {
        let words = &self.lexicon.words;
        let lists = [
            &words.possessives, &words.subjects, &words.be, &words.have, &words.r#do, &words.modals,
            &words.negations, &words.conditionals, &words.habits, &words.guesses,
            &words.subordinators, &words.conjunctions, &words.questions, &words.adverbs,
            &words.places_adverbs, &words.determiners,
        ];
        lists.iter().any(|list| self.is_in(list, at))
            || matches!(self.word(at), "me" | "us" | "him" | "them" | "these" | "those" | "'s")
            || self.preposition(at).is_some()
            || self.is_in(&words.particles, at)
            || self.is_in(&words.interjections, at)
    }

    /// Whether the word may stand in a noun phrase that so far has (or has not) words.
    fn is_nounish(&self, at: usize, determined: bool, words: usize) -> bool {
        let Some(token) = self.tokens.get(at) else { return false };
        if !token.word || self.is_time(at) {
            return false;
        }
        let lists = &self.lexicon.words;
        let adjective = self.is_in(&lists.adjectives, at);
        if adjective && (determined || words > 0 || self.is_plain(at + 1)) {
            let next = self.is_plain(at + 1) || self.is_in(&lists.adjectives, at + 1);
            if next || (determined && words == 0 && !self.is_function_word(at + 1)) {
                return true;
            }
            if determined && words == 0 {
                return true;
            }
        }
        if matches!(self.word(at), "one" | "ones") {
            return words > 0;
        }
        if self.word(at) == "can" && words > 0 && self.verb(at + 1).is_empty() {
            return !self.is_in(&lists.subjects, at + 1) && !self.is_in(&lists.be, at + 1);
        }
        if words == 0 && self.is_in(&lists.parts, at) && self.word(at + 1) == "of" {
            return true;
        }
        if self.is_function_word(at) {
            return false;
        }
        let verb = self.verb(at);
        if verb.is_empty() {
            return true;
        }
        let nouns_too = self.is_in(&lists.nouns_too, at);
        let object_follows = self.is_in(&lists.determiners, at + 1)
            || self.is_in(&lists.possessives, at + 1)
            || self.is_in(&lists.objects, at + 1);
        if determined && words == 0 {
            // "the broken vase", "the book", but not "that broke".
            return nouns_too || self.is_plain(at + 1) || !object_follows;
        }
        let participle = self.has_form(at, &[Form::Participle, Form::Gerund]);
        if words == 0 {
            let gerund = self.has_form(at, &[Form::Gerund]);
            return nouns_too && !participle && !object_follows && !gerund;
        }
        // After an adjective: "the old broken vase"; after a noun: "the tv stand".
        let only_adjectives = (0..words).all(|n| lists.adjectives.contains(self.word(at - 1 - n)));
        (only_adjectives && (participle || nouns_too) && !object_follows && (nouns_too || self.is_plain(at + 1)))
            || (nouns_too && !participle && !object_follows && !self.after_noun_is_verb(at))
    }

    /// Whether a word that may be verb or noun, after a noun, goes on as a verb would.
    fn after_noun_is_verb(&self, at: usize) -> bool {
        let past = self.has_form(at, &[Form::Past, Form::Present]);
        past && !self.is_plain(at + 1) && at + 1 < self.tokens.len() && self.has_form(at, &[Form::Past])
    }

    /// Whether it is a word that is no function word and no verb.
    pub fn is_plain(&self, at: usize) -> bool {
        self.tokens.get(at).is_some_and(|token| token.word)
            && !self.is_time(at)
            && !self.is_function_word(at)
            && (self.verb(at).is_empty() || self.is_in(&self.lexicon.words.nouns_too, at))
    }

    /// The noun phrase that begins at `at`, and where it ends.
    pub fn noun_phrase(&self, at: usize) -> Option<(Phrase, usize)> {
        self.nested_phrase(at, 0)
    }

    fn nested_phrase(&self, at: usize, depth: usize) -> Option<(Phrase, usize)> {
        if self.is_time(at) || depth > 3 {
            return None;
        }
        if let Some(found) = self.pronoun(at) {
            return Some(found);
        }
        let mut phrase = Phrase::default();
        let (mut next, determined) = self.determiners(at, &mut phrase);
        phrase.bare = !determined;
        let first = next;
        while self.is_nounish(next, determined, next - first) || self.is_comma_of_adjectives(first, next) {
            next += 1;
        }
        if next == first {
            return None;
        }
        self.name(first, next, &mut phrase);
        phrase.mention.span = Some((self.tokens[at].span.0, self.tokens[next - 1].span.1));
        if self.word(next) == "'s" && (self.is_plain(next + 1) || self.is_in(&self.lexicon.words.adjectives, next + 1)) {
            return self.possessed(&phrase, next + 1, depth);
        }
        let next = self.of(&mut phrase, next, depth);
        let next = self.relative(&mut phrase, next);
        Some((phrase, next))
    }

    /// "the round, black table".
    fn is_comma_of_adjectives(&self, first: usize, at: usize) -> bool {
        let adjective = |n: usize| self.is_in(&self.lexicon.words.adjectives, n);
        self.word(at) == "," && at > first && adjective(at - 1) && adjective(at + 1) && self.is_plain(at + 2)
    }

    fn pronoun(&self, at: usize) -> Option<(Phrase, usize)> {
        let word = self.word(at);
        let words = &self.lexicon.words;
        let demonstrative = matches!(word, "this" | "that" | "these" | "those" | "both");
        let stands_alone = !demonstrative || !self.is_nounish(at + 1, true, 0) && self.word(at + 1) != "of";
        if !(words.objects.contains(word) || word == "they") || !stands_alone || matches!(word, "one" | "ones") {
            return None;
        }
        let plural = matches!(word, "them" | "they" | "these" | "those" | "both");
        let quantity = if plural { Quantity::All } else { Quantity::One };
        let span = Some(self.tokens[at].span);
        let mention = Mention { noun: word.to_owned(), quantity, span, definite: true, ..Mention::default() };
        Some((Phrase { mention, pronoun: true, plural, ..Phrase::default() }, at + 1))
    }

    /// Reads "all the", "both of my", "two", "another"; where the noun begins, and whether
    /// anything was read.
    fn determiners(&self, at: usize, phrase: &mut Phrase) -> (usize, bool) {
        let words = &self.lexicon.words;
        let mut next = at;
        loop {
            let word = self.word(next);
            if self.is_time(next) {
                break;
            }
            match word {
                "all" | "every" | "each" => phrase.mention.quantity = Quantity::All,
                "both" => phrase.mention.quantity = Quantity::Count(2),
                "no" => phrase.negative = true,
                "of" if next > at && matches!(self.word(next - 1), "all" | "both" | "some" | "each" | "most") => {}
                "last" if next > at => {}
                "more" if next > at && matches!(self.word(next - 1), "no" | "any") => phrase.more = true,
                _ if words.numbers.contains_key(word) || word.bytes().all(|b| b.is_ascii_digit()) && !word.is_empty() => {
                    if word == "one" && !self.is_nounish(next + 1, true, 0) && self.word(next + 1) != "of" {
                        break;
                    }
                    let n = words.numbers.get(word).copied().or_else(|| word.parse().ok());
                    if self.word(next + 1) == "of" {
                        phrase.mention.quantity = n.map_or(Quantity::One, Quantity::Count);
                        next += 2;
                        continue;
                    }
                    phrase.mention.quantity = match n {
                        Some(1) | None => Quantity::One,
                        Some(n) => Quantity::Count(n),
                    };
                }
                _ if words.possessives.contains(word) => {
                    phrase.mention.definite = true;
                    phrase.theirs |= matches!(word, "his" | "her" | "their");
                }
                _ if words.determiners.contains(word) => {
                    phrase.novel |= word == "another";
                    phrase.mention.definite |= !words.indefinite.contains(word) && word != "no";
                    phrase.partial |= word == "some" && self.word(next + 1) == "of";
                }
                "couple" | "few" if next > at && self.word(next - 1) == "a" => {
                    phrase.mention.quantity = if word == "few" { Quantity::All } else { Quantity::Count(2) };
                    next += usize::from(self.word(next + 1) == "of");
                }
                "pair" if next > at && self.word(next + 1) == "of" => next += 1,
                "several" | "many" | "few" => phrase.mention.quantity = Quantity::All,
                _ => break,
            }
            next += 1;
        }
        if matches!(phrase.mention.quantity, Quantity::All) {
            phrase.mention.definite |= matches!(self.word(at), "all" | "every" | "each");
        }
        if self.word(at) == "both" {
            phrase.mention.definite = true;
        }
        (next, next > at)
    }

    /// Adjectives and noun of the tokens `from..to`.
    fn name(&self, from: usize, to: usize, phrase: &mut Phrase) {
        let words = &self.lexicon.words;
        let mut first = from;
        while first + 1 < to && (self.is_in(&words.adjectives, first) || self.is_past_adjective(first) || self.word(first) == ",") {
            let word = self.word(first);
            if word == "," {
                first += 1;
                continue;
            }
            if words.novelty.contains(word) {
                phrase.novel = true;
                phrase.mention.definite = false;
            }
            phrase.mention.adjectives.push(word.to_owned());
            first += 1;
        }
        let nouns: Vec<&str> = (first..to).map(|n| self.word(n)).collect();
        let last = nouns.last().copied().unwrap_or_default();
        phrase.plural = is_plural(last);
        let mut text = nouns.join(" ");
        if phrase.plural && !words.pluralia.contains(last) {
            let one = singular(last);
            text.truncate(text.len() - last.len());
            text += &one;
        }
        if phrase.plural && phrase.mention.definite && phrase.mention.quantity == Quantity::One {
            phrase.mention.quantity = Quantity::All;
        }
        phrase.others = nouns.iter().any(|noun| words.outsiders.contains(*noun));
        phrase.mention.noun = text;
    }

    fn is_past_adjective(&self, at: usize) -> bool {
        self.has_form(at, &[Form::Participle]) && !self.is_in(&self.lexicon.words.nouns_too, at)
    }

    /// "Anna's mug": the mug, with the owner among its adjectives.
    fn possessed(&self, owner: &Phrase, at: usize, depth: usize) -> Option<(Phrase, usize)> {
        let (mut phrase, next) = self.nested_phrase(at, depth + 1)?;
        let mention = &mut phrase.mention;
        let last = mention.noun.rsplit(' ').next().unwrap_or_default();
        if self.lexicon.words.rooms.contains(last) {
            mention.noun = format!("{} {}", owner.mention.noun, mention.noun);
        } else {
            mention.adjectives.push(owner.mention.noun.clone());
        }
        mention.definite = true;
        if phrase.plural && mention.quantity == Quantity::One {
            mention.quantity = Quantity::All;
        }
        mention.span = mention.span.zip(owner.mention.span).map(|(own, owner)| (owner.0, own.1));
        phrase.others |= owner.others;
        phrase.theirs |= owner.theirs;
        Some((phrase, next))
    }

    /// "a box of tissues", "a slice of cake", "the back of the chair", "the counter of the kitchen".
    fn of(&self, phrase: &mut Phrase, at: usize, depth: usize) -> usize {
        if self.word(at) != "of" {
            return at;
        }
        let Some((inner, next)) = self.nested_phrase(at + 1, depth + 1) else { return at };
        let words = &self.lexicon.words;
        let head = phrase.mention.noun.rsplit(' ').next().unwrap_or_default().to_owned();
        let span = phrase.mention.span.zip(inner.mention.span).map(|(a, b)| (a.0, b.1));
        if words.partitives.contains(&head) || words.parts.contains(&head) {
            let partial = matches!(head.as_str(), "piece" | "slice" | "bit" | "half" | "portion" | "handful" | "part");
            let quantity = match phrase.mention.quantity {
                Quantity::One => inner.mention.quantity,
                other => other,
            };
            let whole = Phrase { partial, ..inner };
            *phrase = whole;
            phrase.mention.quantity = quantity;
        } else if words.rooms.contains(inner.mention.noun.rsplit(' ').next().unwrap_or_default()) {
            phrase.mention.at.push(inner.mention);
        } else {
            phrase.others |= inner.others;
            let definite = phrase.mention.definite;
            phrase.mention.noun = format!("{} {}", inner.mention.noun, phrase.mention.noun);
            phrase.mention.definite = definite;
        }
        phrase.mention.span = span;
        next
    }

    /// "that was on the table", "which I bought yesterday", "I got from Anna".
    fn relative(&self, phrase: &mut Phrase, at: usize) -> usize {
        let words = &self.lexicon.words;
        let pronoun = matches!(self.word(at), "that" | "which" | "who");
        let subject = |n: usize| self.is_in(&words.subjects, n) && self.word(n) != "it";
        let begins = at + usize::from(pronoun);
        if pronoun && self.is_in(&words.be, begins) {
            let mut next = begins + 1;
            while self.is_in(&words.adverbs, next) || self.has_form(next, &[Form::Gerund]) {
                next += 1;
            }
            let Some((length, _)) = self.preposition(next) else { return at };
            let Some((place, next)) = self.nested_phrase(next + length, 2) else { return at };
            phrase.mention.at.push(place.mention);
            return next;
        }
        if !subject(begins) || phrase.pronoun || begins == 0 {
            return at;
        }
        let mut next = begins + 1;
        while self.is_in(&words.have, next) || self.is_in(&words.adverbs, next) || self.is_in(&words.be, next) {
            next += 1;
        }
        if !self.has_form(next, &[Form::Past, Form::Participle, Form::Base]) {
            return at;
        }
        next += 1;
        while self.is_time(next) || self.is_in(&words.adverbs, next) || self.is_in(&words.particles, next) {
            next += 1;
        }
        // "the vase I got from Anna": leave the rest to what follows.
        if let Some((length, Preposition::Source | Preposition::Other)) = self.preposition(next)
            && let Some((_, after)) = self.nested_phrase(next + length, 2)
        {
            next = after;
        }
        // A noun phrase here would be the object of that verb: no relative clause then.
        if self.noun_starts(next) { at } else { next }
    }

    /// Whether a noun phrase begins here that a determiner opens.
    pub fn noun_starts(&self, at: usize) -> bool {
        let words = &self.lexicon.words;
        self.is_in(&words.determiners, at) || self.is_in(&words.possessives, at) || self.is_in(&words.objects, at)
    }
}
