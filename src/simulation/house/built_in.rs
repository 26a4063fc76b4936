//! Houses that come with the program: [`BUILT_IN`].

use super::build::{build, read};
use super::{House, HouseError};

/// A house that comes with the program.
#[derive(Clone, Copy, Debug)]
pub struct BuiltIn {
    /// Its name.
    pub name: &'static str,
    /// What it is like.
    pub about: &'static str,
    /// Its house file.
    pub json: &'static str,
}

/// The houses that come with the program; the first is used where none is named.
pub const BUILT_IN: [BuiltIn; 3] = [
    BuiltIn {
        name: "apartment",
        about: "bathroom, bedroom, living room and kitchen",
        json: include_str!("../houses/apartment.json"),
    },
    BuiltIn {
        name: "cottage",
        about: "six rooms along a corridor",
        json: include_str!("../houses/cottage.json"),
    },
    BuiltIn {
        name: "loft",
        about: "an L-shaped living room, and a kitchen, a bedroom and a bathroom around it",
        json: include_str!("../houses/loft.json"),
    },
];

impl BuiltIn {
    /// The built-in house of this name.
    pub fn named(name: &str) -> Option<&'static Self> {
        BUILT_IN.iter().find(|house| house.name == name)
    }

    /// The house.
    pub fn house(&self) -> Result<House, Vec<HouseError>> {
        build(&read(self.json).map_err(|error| vec![error])?, None)
    }
}
