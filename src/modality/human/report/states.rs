//! Statements of place and state: "is gone", "there is", headlines.

use super::{Reporter, Target};
use crate::modality::human::clause::{Clause, Subject, Unreal};
use crate::modality::human::phrase::Phrase;
use crate::modality::human::reading::{Mention, Quantity};
use crate::change::Action;

impl Reporter<'_> {
    /// "is gone", "is on the table", "there is a plant in the hall".
    pub(super) fn state(&mut self, clause: &Clause) {
        let gone = clause.state.iter().any(|word| self.lexicon.words.gone_words.contains(word));
        if clause.subject == Subject::There {
            return self.there_is(clause);
        }
        if clause.past {
            return;
        }
        let things = self.subject_things(clause);
        let out_of = clause.places.iter().find(|place| place.preposition == "out of" && place.things.iter().all(|it| it.bare));
        if let (Some(place), Subject::Pronoun(_)) = (out_of, &clause.subject) {
            let used = self.things(&place.things);
            return self.gone(&Clause { places: Vec::new(), ..clause.clone() }, &used, 0.9);
        }
        if gone || clause.no_longer {
            self.gone(clause, &things, 0.9);
        } else if clause.places.is_empty() && clause.state.iter().any(|word| word == "back") {
            self.put_back(clause, &things, Target::default());
        } else {
            self.is_at(clause, &things);
        }
    }

    pub(super) fn there_is(&mut self, clause: &Clause) {
        if clause.past && !clause.no_longer {
            return;
        }
        let things = self.things(&clause.objects);
        let negative = things.iter().any(|(_, phrase)| phrase.negative) || clause.unreal == Some(Unreal::Negated);
        if negative {
            let used_up = self.is_used_up(clause) || things.iter().any(|(_, phrase)| phrase.more) || clause.no_longer;
            return if used_up { self.gone(clause, &things, 0.9) } else { self.note("a negation") };
        }
        let lists = &self.lexicon.words;
        if clause.state.iter().any(|word| lists.gone_words.contains(word)) {
            return;
        }
        let target = self.where_it_is(clause);
        if target.is_empty() {
            return;
        }
        for (mention, phrase) in &things {
            let definite = mention.definite && !phrase.novel && !matches!(mention.quantity, Quantity::Count(_));
            let object = Mention { definite, ..mention.clone() };
            self.push(clause, Action::Added, object, &target, 0.9);
        }
    }

    /// It is there now, wherever it was before.
    pub(super) fn is_at(&mut self, clause: &Clause, things: &[(Mention, Phrase)]) {
        let target = self.where_it_is(clause);
        if target.is_empty() {
            return;
        }
        for (mention, phrase) in things {
            let unknown = phrase.bare && !phrase.plural && !phrase.pronoun && !self.knows(mention);
            let action = if unknown { Action::Moved } else { Action::Added };
            let definite = (mention.definite || phrase.bare || phrase.pronoun) && !phrase.novel;
            let object = Mention { definite, ..mention.clone() };
            self.push(clause, action, object, &target, 0.9);
        }
    }

    /// "No more milk", "Banana gone", "New plant in the bedroom", "Keys on the counter now".
    pub(super) fn headline(&mut self, clause: &Clause) {
        let things = self.things(&clause.objects);
        let gone = clause.state.iter().any(|word| self.lexicon.words.gone_words.contains(word));
        let used_up = things.iter().any(|(_, phrase)| phrase.negative && (phrase.more || clause.state.iter().any(|word| word == "left")));
        if gone || used_up {
            self.gone(clause, &things, 0.9);
        } else if things.iter().all(|(_, phrase)| phrase.novel) || clause.now {
            self.is_at(clause, &things);
        }
    }
}
