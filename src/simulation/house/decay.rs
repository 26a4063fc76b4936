//! How soon things are moved: [`DECAY_CLASSES`].

use std::f64::consts::LN_2;

/// Things that are moved equally soon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DecayClass {
    /// Its name in house files.
    pub name: &'static str,
    /// Hours after which it is as likely as not that such a thing was moved; none: it stays.
    pub half_life_h: Option<f64>,
    /// Some of the things meant.
    pub examples: &'static str,
}

const fn class(name: &'static str, half_life_h: Option<f64>, examples: &'static str) -> DecayClass {
    DecayClass { name, half_life_h, examples }
}

/// The decay classes of house files, soonest first. Rough figures for a lived-in home, to be
/// replaced by what is learned from recordings.
pub const DECAY_CLASSES: [DecayClass; 11] = [
    class("food", Some(6.0), "banana, bread, milk"),
    class("tableware", Some(8.0), "mug, plate, pan"),
    class("device", Some(12.0), "tv remote, phone, laptop"),
    class("clothing", Some(24.0), "clothes, shoes, backpack"),
    class("toiletry", Some(24.0), "toothbrush, shampoo"),
    class("book", Some(48.0), "book, newspaper"),
    class("toy", Some(48.0), "ball, teddy bear, guitar"),
    class("textile", Some(96.0), "towel, pillow, blanket"),
    class("appliance", Some(720.0), "toaster, lamp, bin"),
    class("decoration", Some(720.0), "plant, vase, picture frame"),
    class("furniture", None, "sofa, table, refrigerator; walls and what hangs on them"),
];

/// The decay class of this name.
pub fn decay_class(name: &str) -> Option<DecayClass> {
    DECAY_CLASSES.into_iter().find(|class| class.name == name)
}

/// λ in 1/s of a half-life in hours: p = 2 / (1 + e^{λΔt}) is one half where e^{λΔt} = 3, so
/// λ = ln 3 / half-life (paper, "Time").
pub fn decay_rate_of(half_life_h: f64) -> f64 {
    // ln 3 = ln 2 + ln 1.5.
    (LN_2 + 0.405_465_108_108_164_4) / (half_life_h * 3600.0)
}

impl DecayClass {
    /// λ in 1/s; 0 for what stays.
    pub fn decay_rate(&self) -> f64 {
        self.half_life_h.map_or(0.0, decay_rate_of)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::shapes;

    #[test]
    fn after_the_half_life_half_is_left() {
        for half_life_h in [0.5, 8.0, 720.0] {
            let p = 2.0 / (1.0 + libm::exp(decay_rate_of(half_life_h) * half_life_h * 3600.0));
            assert!((p - 0.5).abs() < 1e-12);
        }
    }

    #[test]
    fn every_drawn_class_has_a_decay_class() {
        for class in shapes::classes() {
            assert!(decay_class(class.decay).is_some(), "{}: {}", class.name, class.decay);
        }
    }
}
