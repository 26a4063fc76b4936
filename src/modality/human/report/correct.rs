//! Corrections of what was said before.

use super::{Correction, Reporter, Target};
use crate::modality::human::clause::{Clause, Place, Subject};
use crate::modality::human::lexicon::Frame;
use crate::modality::human::reading::Mention;
use crate::modality::human::token::Sentence;

impl Reporter<'_> {
    /// "no, I meant the red one", "sorry, in the bedroom".
    pub(super) fn corrects(&mut self, sentence: &Sentence, clauses: &[Clause]) -> bool {
        let Some(clause) = clauses.last() else { return false };
        let starts = |word: &str| sentence.tokens.first().is_some_and(|token| token.is(word));
        let opens = ["no", "nope", "sorry", "actually", "wait", "not", "oops", "correction"].iter().any(|word| starts(word));
        let means = clauses.iter().any(|it| it.verb.as_ref().is_some_and(|verb| verb.frame == Frame::Mean));
        let fragment = clause.verb.is_none() && !clause.copula && opens && !clause.objects.iter().any(|it| it.negative);
        let is_one = clause.copula && clause.places.is_empty()
            && matches!(&clause.subject, Subject::Pronoun(it) if it == "it" || it == "that")
            && clause.objects.iter().any(|it| it.mention.noun == "one");
        let answer = clauses.len() == 1
            && clause.verb.is_none()
            && !clause.copula
            && clause.objects.len() == 1
            && clause.objects[0].mention.definite;
        if !(means || fragment || is_one || answer) || !self.drafts.is_empty() {
            return false;
        }
        let answer = answer && !(means || fragment || is_one);
        let object = clause.objects.first().map(|it| it.mention.clone());
        // "the one on the table": the place tells which, not where to.
        let places: Vec<Place> = if answer { Vec::new() } else { clause.places.clone() };
        let at = clause.places.iter().filter(|_| answer).flat_map(|place| &place.things);
        let at: Vec<Mention> = at.map(|it| it.mention.clone()).collect();
        let object = object.map(|it| Mention { at: [it.at.clone(), at].concat(), ..it });
        let Target { support, room } = self.target_of(&places);
        if object.is_none() && support.is_none() && room.is_none() {
            return means;
        }
        self.correction = Some(Correction { object, support, target_room: room, answer });
        true
    }
}
