//! Making statements, and completing those whose place is told later.

use super::{Draft, MAX_STATEMENTS, Reporter, Target};
use crate::modality::human::clause::Clause;
use crate::modality::human::lexicon::Preposition;
use crate::modality::human::phrase::Phrase;
use crate::modality::human::reading::{Mention, Statement, When};
use crate::change::Action;

impl Reporter<'_> {
    /// The mention with where it is said to have been.
    pub(super) fn with_hints(&self, clause: &Clause, mention: &Mention, removal: bool) -> Mention {
        let mut mention = mention.clone();
        let strong = clause.places.iter().position(|place| place.role == Preposition::Goal(true));
        for (n, place) in clause.places.iter().enumerate() {
            let source = place.role == Preposition::Source;
            let was_there = matches!(place.role, Preposition::Goal(false) | Preposition::Near)
                && (removal || strong.is_some_and(|strong| n < strong));
            if source || was_there {
                let there = place.things.iter().flat_map(|it| self.resolve(it));
                mention.at.extend(there.filter(|it| !self.is_being(it)));
            }
        }
        mention
    }

    pub(super) fn gone(&mut self, clause: &Clause, things: &[(Mention, Phrase)], confidence: f64) {
        for (mention, _) in things {
            let object = Mention { definite: true, ..self.with_hints(clause, mention, true) };
            self.push(clause, Action::Removed, object, &Target::default(), confidence);
        }
    }

    pub(super) fn mark(&mut self, from: usize, open: bool, needs_place: bool) {
        for draft in &mut self.drafts[from..] {
            draft.open = open;
            draft.needs_place = needs_place;
        }
    }

    pub(super) fn push(&mut self, clause: &Clause, action: Action, object: Mention, target: &Target, confidence: f64) {
        let just = When { earliest_s: 600.0, latest_s: 0.0 };
        let when = clause.when.or(clause.just.then_some(just));
        let confidence = if clause.belief { confidence * 0.65 } else { confidence };
        let statement = Statement {
            action,
            object,
            support: target.support.clone(),
            source_room: None,
            target_room: target.room.clone(),
            when,
            confidence,
        };
        let draft = Draft { statement, open: false, needs_place: false };
        if !self.complete(&draft) && self.drafts.len() <= MAX_STATEMENTS {
            self.drafts.push(draft);
        }
    }

    /// "I took the mug and put it on the desk" is one change: the place completes the first.
    pub(super) fn complete(&mut self, with: &Draft) -> bool {
        let new = &with.statement;
        let same = |draft: &&mut Draft| draft.statement.object.span == new.object.span && new.object.span.is_some();
        let Some(before) = self.drafts.iter_mut().rev().find(same) else { return false };
        let old = &mut before.statement;
        let told = new.support.is_some() || new.target_room.is_some() || new.action == Action::Removed;
        let refines = !before.open
            && old.action != Action::Removed
            && new.action != Action::Removed
            && new.support.is_some()
            && new.target_room.is_none()
            && old.support.is_none();
        if !(before.open && told || refines) {
            return false;
        }
        let (definite, added) = (old.object.definite, old.action == Action::Added);
        let at = std::mem::take(&mut old.object.at);
        let room = old.target_room.take().filter(|_| refines);
        let when = new.when.or(old.when);
        let action = if added || old.action == new.action { old.action } else { new.action };
        let action = if refines { action } else if added { Action::Added } else { new.action };
        let action = if new.action == Action::Removed { new.action } else { action };
        *old = Statement { when, action, ..new.clone() };
        old.object.definite = definite;
        old.object.at = at;
        if let Some(room) = room {
            if let Some(support) = &mut old.support {
                support.at.push(room.clone());
            }
            old.target_room = Some(room);
        }
        before.open = false;
        true
    }
}
