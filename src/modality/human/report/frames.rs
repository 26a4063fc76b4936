//! What each frame of a verb says of its things.

use super::{Reporter, Target};
use crate::modality::human::clause::{Clause, Place, Subject, Verb};
use crate::modality::human::lexicon::{Frame, Preposition};
use crate::modality::human::phrase::Phrase;
use crate::modality::human::reading::Mention;
use crate::change::Action;

impl Reporter<'_> {
    pub(super) fn gone_verb(&mut self, clause: &Clause, verb: &Verb, things: &[(Mention, Phrase)]) {
        let to_speaker = |phrase: &Phrase| matches!(phrase.mention.noun.as_str(), "me" | "us");
        let received = verb.lemma == "give" && clause.objects.first().is_some_and(to_speaker);
        let speaker = matches!(&clause.subject, Subject::Pronoun(who) if matches!(who.as_str(), "i" | "we"));
        if received || (verb.lemma == "borrow" && speaker && !things.iter().all(|it| it.0.definite)) {
            return self.acquire(clause, things, Target::default(), false);
        }
        let used_up = |it: &&(Mention, Phrase)| self.is_consumable(&it.0);
        if matches!(verb.lemma.as_str(), "finish" | "have") {
            // "I finished the book" leaves the book.
            let things: Vec<_> = things.iter().filter(used_up).cloned().collect();
            return self.gone(clause, &things, 0.9);
        }
        self.gone(clause, things, 0.9);
    }

    fn is_consumable(&self, mention: &Mention) -> bool {
        let last = mention.noun.rsplit(' ').next().unwrap_or_default();
        self.lexicon.words.consumables.contains(last)
    }

    pub(super) fn toss(&mut self, clause: &Clause, verb: &Verb, things: &[(Mention, Phrase)], target: Target) {
        let words = &self.lexicon.words;
        let to_waste = target.support.as_ref().is_some_and(|it| words.waste.contains(&it.noun) || words.waste.contains(it.noun.rsplit(' ').next().unwrap_or_default()));
        let nowhere = target.is_empty() && verb.lemma != "throw" && clause.places.is_empty();
        if to_waste || nowhere {
            let without = Clause { places: only_sources(clause), ..clause.clone() };
            self.gone(&without, things, 0.9);
        } else if !target.is_empty() {
            self.placed(clause, things, target);
        }
    }

    pub(super) fn take(&mut self, clause: &Clause, verb: &Verb, things: &[(Mention, Phrase)], target: Target) {
        let light = |it: &(Mention, Phrase)| {
            (!it.0.definite
                && self.lexicon.words.light_objects.contains(it.0.noun.rsplit(' ').next().unwrap_or_default())) || (it.1.bare && it.0.noun == "place")
        };
        if things.iter().any(light) {
            return;
        }
        let indefinite = things.iter().all(|(mention, phrase)| !mention.definite && !phrase.pronoun);
        let anywhere = clause.places.iter().any(|place| place.role != Preposition::Other);
        if matches!(verb.lemma.as_str(), "pick" | "collect" | "fetch") && indefinite && !anywhere {
            // "I picked up some milk": from a shop.
            return self.acquire(clause, things, target, true);
        }
        let along = clause.places.iter().any(|place| place.preposition == "with" && place.things.iter().any(|it| it.pronoun || self.is_being(&it.mention)));
        let strong = clause.places.iter().any(|place| place.role == Preposition::Goal(true));
        if !along && strong && !target.is_empty() {
            return self.moved(clause, things, target);
        }
        let out_of = clause.places.iter().any(|place| place.role == Preposition::Source);
        if along || (verb.frame == Frame::Out && !out_of) {
            let places = clause.places.iter().filter(|place| place.role != Preposition::Goal(true)).cloned().collect();
            return self.gone(&Clause { places, ..clause.clone() }, things, 0.9);
        }
        let from = self.drafts.len();
        self.gone(clause, things, 0.7);
        self.drafts[from..].iter_mut().for_each(|draft| draft.open = true);
    }

    pub(super) fn placed(&mut self, clause: &Clause, things: &[(Mention, Phrase)], target: Target) {
        if is_own_place(&target) {
            return self.put_back(clause, things, Target::default());
        }
        if target.is_empty() {
            return self.note("it does not say where it was put");
        }
        for (mention, phrase) in things {
            let bare = phrase.bare && !phrase.plural && !phrase.pronoun && !self.knows(mention);
            let action = if bare { Action::Moved } else { Action::Added };
            let definite = !phrase.novel;
            let object = Mention { definite, ..self.with_hints(clause, mention, false) };
            self.push(clause, action, object, &target, 0.9);
        }
    }

    pub(super) fn moved(&mut self, clause: &Clause, things: &[(Mention, Phrase)], target: Target) {
        if is_own_place(&target) {
            return self.put_back(clause, things, Target::default());
        }
        for (mention, phrase) in things {
            let novel = phrase.novel && !target.is_empty();
            let action = if novel { Action::Added } else { Action::Moved };
            let object = Mention { definite: !novel, ..self.with_hints(clause, mention, false) };
            let from = self.drafts.len();
            self.push(clause, action, object, &target, 0.9);
            if target.is_empty() {
                self.drafts[from..].iter_mut().for_each(|draft| draft.open = true);
            }
        }
    }

    pub(super) fn bring(&mut self, clause: &Clause, things: &[(Mention, Phrase)], target: Target) {
        for (mention, phrase) in things {
            let definite = mention.definite && !phrase.novel;
            let object = Mention { definite, ..self.with_hints(clause, mention, false) };
            let from = self.drafts.len();
            self.push(clause, Action::Added, object, &target, 0.9);
            self.mark(from, target.is_empty(), definite || (phrase.bare && !phrase.plural));
        }
    }

    pub(super) fn get(&mut self, clause: &Clause, verb: &Verb, things: &[(Mention, Phrase)], target: Target) {
        let sourced = clause.places.iter().any(|place| place.role == Preposition::Source);
        let definite = things.iter().any(|(mention, phrase)| mention.definite && !phrase.novel);
        if definite {
            return self.take(clause, verb, things, target);
        }
        let novel = things.iter().any(|(_, phrase)| phrase.novel);
        self.acquire(clause, things, target, !novel || sourced);
    }

    pub(super) fn acquire(&mut self, clause: &Clause, things: &[(Mention, Phrase)], target: Target, needs_place: bool) {
        for (mention, _) in things {
            let at = Vec::new();
            let object = Mention { definite: false, at, ..mention.clone() };
            let from = self.drafts.len();
            self.push(clause, Action::Added, object, &target, 0.9);
            self.mark(from, target.is_empty(), needs_place);
        }
    }

    pub(super) fn put_back(&mut self, clause: &Clause, things: &[(Mention, Phrase)], target: Target) {
        if !target.is_empty() {
            return self.placed(clause, things, target);
        }
        for (mention, _) in things {
            let object = Mention { definite: true, ..mention.clone() };
            let room = Some(Mention { its_place: true, ..object.clone() });
            self.push(clause, Action::Moved, object, &Target { support: None, room }, 0.9);
        }
    }

    pub(super) fn swap(&mut self, clause: &Clause, verb: &Verb, things: &[(Mention, Phrase)]) {
        let mut both: Vec<Mention> = things.iter().map(|it| it.0.clone()).collect();
        let with = clause.places.iter().find(|place| matches!(place.preposition.as_str(), "with" | "for"));
        if let Some(place) = with {
            both.extend(self.things(&place.things).into_iter().map(|it| it.0));
        }
        let lasting = |it: &Mention| Mention { definite: true, ..it.clone() };
        if let [a, b] = both.as_slice() {
            if !b.definite && with.is_some() {
                // "I swapped the lamp for a new one".
                return self.replace(clause, verb, things);
            }
            for (object, place) in [(a, b), (b, a)] {
                let room = Some(Mention { its_place: true, ..lasting(place) });
                self.push(clause, Action::Moved, lasting(object), &Target { support: None, room }, 0.9);
            }
        }
    }

    pub(super) fn replace(&mut self, clause: &Clause, verb: &Verb, things: &[(Mention, Phrase)]) {
        let by = |place: &&Place| matches!(place.preposition.as_str(), "with" | "by" | "for");
        let with = clause.places.iter().find(by);
        let Some(new) = with.map(|place| &place.things).filter(|_| verb.frame != Frame::None) else { return };
        let without = Clause { places: Vec::new(), ..clause.clone() };
        self.gone(&without, things, 0.9);
        let Some((old, _)) = things.first() else { return };
        let antecedents = std::mem::replace(&mut self.antecedents, vec![old.clone()]);
        let new = self.things(new);
        self.antecedents = antecedents;
        for (mention, phrase) in new {
            let definite = mention.definite && !phrase.novel;
            let room = Some(Mention { its_place: true, definite: true, ..old.clone() });
            let object = Mention { definite, ..mention };
            self.push(clause, Action::Added, object, &Target { support: None, room }, 0.9);
        }
    }

    pub(super) fn seen(&mut self, clause: &Clause, things: &[(Mention, Phrase)]) {
        let known: Vec<_> = things.iter().filter(|(mention, phrase)| !phrase.bare || phrase.plural || self.knows(mention)).cloned().collect();
        let from = self.drafts.len();
        self.is_at(clause, &known);
        self.drafts[from..].iter_mut().for_each(|draft| draft.statement.confidence *= 0.9);
    }

    pub(super) fn have(&mut self, clause: &Clause, things: &[(Mention, Phrase)], target: Target) {
        if clause.past {
            // "I had the banana": for breakfast.
            let eaten: Vec<_> = things.iter().filter(|it| it.0.definite && self.is_consumable(&it.0)).cloned().collect();
            return self.gone(&Clause { places: Vec::new(), ..clause.clone() }, &eaten, 0.7);
        }
        if self.is_used_up(clause) || things.iter().any(|(_, phrase)| phrase.negative && phrase.more) {
            return self.gone(clause, things, 0.9);
        }
        let mut target = target;
        if let (Subject::Things(subject), true) = (&clause.subject, target.is_empty()) {
            target.room = subject.first().map(|it| it.mention.clone()).filter(|it| self.is_room(it));
        }
        let light = |it: &(Mention, Phrase)| self.lexicon.words.light_objects.contains(&it.0.noun) || it.1.negative;
        if target.is_empty() || things.iter().any(light) {
            return;
        }
        for (mention, phrase) in things {
            let definite = mention.definite && !phrase.novel;
            let object = Mention { definite, ..mention.clone() };
            self.push(clause, Action::Added, object, &target, 0.9);
        }
    }
}

fn only_sources(clause: &Clause) -> Vec<Place> {
    clause.places.iter().filter(|place| place.role == Preposition::Source).cloned().collect()
}

/// "in its place", "where it belongs".
fn is_own_place(target: &Target) -> bool {
    let own = |it: &Mention| matches!(it.noun.as_str(), "place" | "spot" | "usual place" | "usual spot" | "original place");
    target.support.as_ref().is_some_and(own)
}
