//! Where something is now, by the places that a clause names.

use super::{Reporter, Target};
use crate::modality::human::clause::{Clause, Place, Verb};
use crate::modality::human::lexicon::{Frame, Preposition};
use crate::modality::human::reading::Mention;

impl Reporter<'_> {
    pub(super) fn where_it_is(&self, clause: &Clause) -> Target {
        let places = clause.places.iter().filter(|place| place.role != Preposition::Source && place.preposition != "to");
        let places: Vec<Place> = places.cloned().collect();
        self.target_of(&places)
    }

    /// Where the verb puts its object.
    pub(super) fn target(&self, clause: &Clause, verb: &Verb) -> Target {
        let strong = clause.places.iter().position(|place| place.role == Preposition::Goal(true));
        let from = match verb.frame {
            Frame::Take | Frame::Out | Frame::Move | Frame::Bring | Frame::Get => strong.unwrap_or(0),
            _ => 0,
        };
        let mut target = self.target_of(&clause.places[from.min(clause.places.len())..]);
        // "a new lamp for the bedroom".
        let for_room = clause.places.iter().find(|place| place.preposition == "for");
        if let (Some(place), true) = (for_room, target.is_empty() && matches!(verb.frame, Frame::Acquire | Frame::Get | Frame::Bring)) {
            target.room = place.things.first().map(|it| it.mention.clone()).filter(|it| self.is_room(it));
        }
        target
    }

    pub(super) fn target_of(&self, places: &[Place]) -> Target {
        let mut target = Target::default();
        let goals = places.iter().filter(|place| matches!(place.role, Preposition::Goal(_) | Preposition::Near));
        let mut near = false;
        for place in goals {
            let Some(thing) = place.things.first() else { continue };
            if thing.bare && !thing.plural && !self.knows(&thing.mention) && !thing.pronoun && !self.is_away(&thing.mention) {
                continue;
            }
            let Some(mention) = self.resolve(thing).into_iter().next() else { continue };
            let first = target.is_empty();
            if self.is_room(&mention) {
                if let Some(support) = &mut target.support {
                    support.at.push(mention.clone());
                }
                target.room.get_or_insert(mention);
            } else if first && place.role == Preposition::Near {
                near = true;
                target.room = Some(mention);
            } else if near && place.role != Preposition::Near {
                // "next to the vase on the shelf".
                near = false;
                target = Target { room: None, support: Some(mention) };
            } else if first {
                target.room = mention.at.first().filter(|at| self.is_room(at)).cloned();
                target.support = Some(mention);
            } else if let Some(support) = &mut target.support {
                support.at.push(mention);
            } else if target.room.as_ref().is_some_and(|room| self.is_room(room)) {
                // "in the kitchen on the table".
                if place.role != Preposition::Near {
                    let at = target.room.iter().cloned().collect();
                    target.support = Some(Mention { at, ..mention });
                }
            }
        }
        target
    }

    pub(super) fn is_room(&self, mention: &Mention) -> bool {
        let head = mention.noun.rsplit(' ').next().unwrap_or_default();
        let one_word = head.len() > 4 && head.ends_with("room") && head != "mushroom";
        (self.lexicon.words.rooms.contains(head) || one_word) && !matches!(mention.noun.as_str(), "toilet")
    }

    pub(super) fn is_away(&self, mention: &Mention) -> bool {
        self.lexicon.words.away_places.contains(mention.noun.rsplit(' ').next().unwrap_or_default())
    }

    /// Whether the lexicon knows the noun, so that it needs no determiner to be a thing.
    pub(super) fn knows(&self, mention: &Mention) -> bool {
        let names = &self.lexicon.names;
        let head = mention.noun.rsplit(' ').next().unwrap_or_default();
        let name = |text: &str| names.knows(&crate::modality::human::names::Name::new(text));
        name(&mention.noun) || name(head) || self.is_room(mention) || self.lexicon.words.waste.contains(head)
    }
}
