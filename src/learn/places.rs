//! [`PlaceModel`]: where a thing is, by the hour of the day, learned by counting.
//!
//! Whether a thing of class c that was at place p at hour h is there after a gap g is counted at
//! four levels, each a special case of the one before: (g), (c, g), (c, p, g), (c, p, h, g). The
//! probability at a level is its share of stays, drawn towards that of the level before by two
//! pseudo-counts: with few data it is the wider level, with many its own (a hierarchical beta
//! prior; `MacKay` and Peto, "A hierarchical Dirichlet language model", 1995). Where else it is,
//! is told by where its class is at that hour.

use std::collections::BTreeMap;

use super::history::Spot;
use super::looks::Look;

/// Pseudo-counts with which a level is drawn to the one before.
const DRAW: f64 = 2.0;

/// Stays, and looks.
type Count = [f64; 2];

/// Counts of where things of each class are and whether they stay. `P` names places.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaceModel<P: Ord + Clone = Spot> {
    /// Gaps in seconds, rising.
    gaps_s: Vec<f64>,
    by_gap: Vec<Count>,
    by_class: BTreeMap<(String, usize), Count>,
    by_place: BTreeMap<(String, P, usize), Count>,
    by_hour: BTreeMap<(String, P, usize, usize), Count>,
    /// How often a thing of the class was found at each place, by hour of the day.
    found: BTreeMap<String, BTreeMap<P, [f64; 24]>>,
}

impl<P: Ord + Clone> PlaceModel<P> {
    /// A model without data, for these gaps in seconds, which must rise.
    pub fn new(gaps_s: Vec<f64>) -> Self {
        let by_gap = vec![Count::default(); gaps_s.len()];
        let (by_class, by_place, by_hour) = Default::default();
        Self { gaps_s, by_gap, by_class, by_place, by_hour, found: BTreeMap::new() }
    }

    /// The gaps it knows, in seconds.
    pub fn gaps_s(&self) -> &[f64] {
        &self.gaps_s
    }

    /// Counts `looks` looks at `place` at `hour`, after the gap of which `stays` found it there.
    pub fn count(&mut self, class: &str, place: &P, hour: usize, gap: usize, [stays, looks]: Count) {
        let (class, add) = (class.to_owned(), |count: &mut Count| {
            count[0] += stays;
            count[1] += looks;
        });
        add(&mut self.by_gap[gap]);
        add(self.by_class.entry((class.clone(), gap)).or_default());
        add(self.by_place.entry((class.clone(), place.clone(), gap)).or_default());
        add(self.by_hour.entry((class, place.clone(), hour, gap)).or_default());
    }

    /// Counts things of the class found at a place at an hour.
    pub fn count_found(&mut self, class: &str, place: &P, hour: usize, times: f64) {
        let places = self.found.entry(class.to_owned()).or_default();
        places.entry(place.clone()).or_insert([0.0; 24])[hour] += times;
    }

    /// Whether things of the class were ever counted, at each gap.
    pub fn knows(&self, class: &str) -> bool {
        let counted = |gap| self.by_class.contains_key(&(class.to_owned(), gap));
        !self.gaps_s.is_empty() && (0..self.gaps_s.len()).all(counted)
    }

    /// Probability that a thing that is at `place` at `hour` is there `after_s` seconds later:
    /// between the gaps it knows, in a straight line; beyond the last, that of the last.
    pub fn stays(&self, class: &str, place: &P, hour: usize, after_s: f64) -> f64 {
        let next = self.gaps_s.partition_point(|gap| *gap < after_s);
        let at = |gap: usize| self.stays_for(class, place, hour, gap);
        match (next.checked_sub(1), self.gaps_s.get(next)) {
            (Some(last), None) => at(last),
            (None, None) => 1.0,
            (before, Some(right_s)) => {
                let (left_s, left) = before.map_or((0.0, 1.0), |it| (self.gaps_s[it], at(it)));
                let share = (after_s - left_s) / (right_s - left_s);
                left + share * (at(next) - left)
            }
        }
    }

    /// As [`PlaceModel::stays`], for one of the gaps.
    pub fn stays_for(&self, class: &str, place: &P, hour: usize, gap: usize) -> f64 {
        let class = class.to_owned();
        let place = place.clone();
        let levels = [
            self.by_gap.get(gap),
            self.by_class.get(&(class.clone(), gap)),
            self.by_place.get(&(class.clone(), place.clone(), gap)),
            self.by_hour.get(&(class, place, hour, gap)),
        ];
        levels.into_iter().flatten().fold(0.5, |wider, [stays, looks]| {
            (stays + DRAW * wider) / (looks + DRAW)
        })
    }

    /// Where a thing of the class is at an hour of the day, most probable first; shares of 1.
    pub fn places_at(&self, class: &str, hour: usize) -> Vec<(&P, f64)> {
        self.shares(class, |hours| hours[hour])
    }

    /// Where a thing of the class is at any time, most probable first; shares of 1.
    pub fn places(&self, class: &str) -> Vec<(&P, f64)> {
        self.shares(class, |hours| hours.iter().sum())
    }

    fn shares(&self, class: &str, weight: impl Fn(&[f64; 24]) -> f64) -> Vec<(&P, f64)> {
        let Some(places) = self.found.get(class) else { return Vec::new() };
        let total: f64 = places.values().map(&weight).sum();
        if total <= 0.0 {
            return Vec::new();
        }
        let mut shares: Vec<(&P, f64)> =
            places.iter().map(|(place, hours)| (place, weight(hours) / total)).collect();
        shares.sort_by(|a, b| b.1.total_cmp(&a.1).then_with(|| a.0.cmp(b.0)));
        shares
    }

    /// The most probable place of a thing that is at `place` at `hour`, after a gap.
    pub fn likeliest(&self, class: &str, place: &P, hour: usize, after_s: f64) -> P {
        let stays = self.stays(class, place, hour, after_s);
        let then = (hour + libm::round(after_s / 3600.0) as usize) % 24;
        let others: Vec<(&P, f64)> =
            self.places_at(class, then).into_iter().filter(|(other, _)| *other != place).collect();
        let total: f64 = others.iter().map(|(_, share)| share).sum();
        match others.first() {
            Some((other, share)) if (1.0 - stays) * share / total > stays => (*other).clone(),
            _ => place.clone(),
        }
    }

    /// What is counted: class, place, hour, gap, stays and looks; to be written.
    pub fn counts(&self) -> impl Iterator<Item = (&str, &P, usize, usize, Count)> {
        self.by_hour.iter().map(|((class, place, hour, gap), count)| {
            (class.as_str(), place, *hour, *gap, *count)
        })
    }

    /// How often things of each class were found at each place, by hour of the day.
    pub fn found(&self) -> impl Iterator<Item = (&str, &P, &[f64; 24])> {
        self.found.iter().flat_map(|(class, places)| {
            places.iter().map(move |(place, hours)| (class.as_str(), place, hours))
        })
    }
}

impl PlaceModel<Spot> {
    /// Counts a look.
    pub fn look(&mut self, look: &Look<'_>) {
        let stays = f64::from(u8::from(look.stayed()));
        self.count(look.class, &look.spot, look.hour(), look.gap, [stays, 1.0]);
        if let Some(then) = look.then {
            self.count_found(look.class, &then, look.hour_then(), 1.0);
        }
        if look.gap == 0 {
            self.count_found(look.class, &look.spot, look.hour(), 1.0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn model() -> PlaceModel<&'static str> {
        let mut model = PlaceModel::new(vec![3600.0, 7200.0]);
        // In the morning the mug leaves the cupboard, in the evening it stays.
        model.count("mug", &"cupboard", 7, 0, [5.0, 50.0]);
        model.count("mug", &"cupboard", 20, 0, [48.0, 50.0]);
        model.count("mug", &"cupboard", 7, 1, [2.0, 50.0]);
        model.count_found("mug", &"sink", 8, 45.0);
        model.count_found("mug", &"cupboard", 8, 5.0);
        model
    }

    #[test]
    fn the_hour_of_the_day_decides_where_there_is_data() {
        let model = model();
        assert!(model.stays("mug", &"cupboard", 7, 3600.0) < 0.15);
        assert!(model.stays("mug", &"cupboard", 20, 3600.0) > 0.9);
        let unknown_hour = model.stays("mug", &"cupboard", 12, 3600.0);
        assert!((0.4..0.6).contains(&unknown_hour), "{unknown_hour}");
    }

    #[test]
    fn between_gaps_the_line_is_straight_and_at_once_nothing_has_moved() {
        let model = model();
        let at = |after_s| model.stays("mug", &"cupboard", 7, after_s);
        assert!((at(0.0) - 1.0).abs() < 1e-12);
        assert!((at(1800.0) - f64::midpoint(1.0, at(3600.0))).abs() < 1e-12);
        assert!((at(5400.0) - f64::midpoint(at(3600.0), at(7200.0))).abs() < 1e-12);
        assert!((at(1e6) - at(7200.0)).abs() < 1e-12);
    }

    #[test]
    fn the_likeliest_place_is_where_its_class_is_at_that_hour() {
        let model = model();
        assert_eq!(model.likeliest("mug", &"cupboard", 7, 3600.0), "sink");
        assert_eq!(model.likeliest("mug", &"cupboard", 20, 3600.0), "cupboard");
        assert_eq!(model.likeliest("spoon", &"drawer", 7, 3600.0), "drawer");
        assert_eq!(model.places_at("mug", 8)[0], (&"sink", 0.9));
        assert!(model.places("spoon").is_empty());
    }
}
