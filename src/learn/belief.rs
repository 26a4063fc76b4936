//! [`Beliefs`]: how probable it is that an object is where the graph says, by any of the models.

use std::fmt;
use std::str::FromStr;

use super::document::Learned;
use super::looks::hour_of;
use crate::graph::{NodeId, Object, SceneGraph};
use crate::modality::time::probability_static;
use crate::time::Stamp;

/// How time is thought to work.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TimeModel {
    /// The paper's p = 2/(1 + e^{λt}).
    #[default]
    Sigmoid,
    /// It may have come back.
    BirthDeath,
    /// By place and hour of the day.
    Places,
}

impl TimeModel {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Sigmoid, Self::BirthDeath, Self::Places];

    /// Its name on the command line.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Sigmoid => "sigmoid",
            Self::BirthDeath => "birth-death",
            Self::Places => "places",
        }
    }
}

impl fmt::Display for TimeModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

impl FromStr for TimeModel {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let found = Self::ALL.into_iter().find(|it| it.as_str() == text);
        found.ok_or_else(|| format!("{text:?} is none of sigmoid, birth-death, places"))
    }
}

/// A model, and what was learned for it, if anything was.
#[derive(Clone, Copy, Debug, Default)]
pub struct Beliefs<'l> {
    /// Which model.
    pub model: TimeModel,
    /// What was learned; without it, λ of each node decides.
    pub learned: Option<&'l Learned>,
}

impl Beliefs<'_> {
    /// Probability that an object of the graph is at `now` where it was last observed. What the
    /// graph says is immovable is there, unless its class was learned. Where the model knows
    /// nothing of a class, the sigmoid decides, and where that knows nothing, λ of the node.
    pub fn probability(&self, graph: &SceneGraph, object: &Object, now: Stamp) -> f64 {
        let Some(learned) = self.learned else { return object.probability_static(now) };
        let age_s = now.seconds_since(object.last_observed);
        let (label, class) = (&object.label, object.label.as_str());
        let known = learned.classes.contains_key(class);
        if object.decay_rate <= 0.0 && !known && learned.table.stated(label).is_none() {
            return 1.0;
        }
        let by_model = match self.model {
            TimeModel::Sigmoid => None,
            TimeModel::BirthDeath => learned.birth_death(class, age_s),
            TimeModel::Places => {
                let place = place_name(graph, object.support.unwrap_or(object.room));
                let hour = hour_of(object.last_observed.nanos());
                learned.places(class, &place, hour, age_s)
            }
        };
        by_model.unwrap_or_else(|| {
            let decay = learned.table.for_object(label, object.decay_rate);
            let rate = decay.map_or(object.decay_rate, |(decay, _)| decay.rate_per_s);
            probability_static(rate, age_s)
        })
    }
}

/// What a place is called where places are learned: `counter O12`.
pub(super) fn place_name(graph: &SceneGraph, id: NodeId) -> String {
    graph.label(id).map_or_else(|| id.to_string(), |label| format!("{label} {id}"))
}
