//! [`NodeId`]: a layer letter and an index in 64 bits, as Spark-DSG has them.

use std::fmt;
use std::str::FromStr;

/// A layer of the graph, lowest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Layer {
    /// Things: mugs, tables, walls.
    Object,
    /// Rooms.
    Room,
    /// Storeys.
    Floor,
    /// Buildings.
    Building,
}

impl Layer {
    /// All layers, lowest first.
    pub const ALL: [Self; 4] = [Self::Object, Self::Room, Self::Floor, Self::Building];

    /// The letter in ids: `O`, `R`, `F`, `B`.
    pub const fn letter(self) -> u8 {
        match self {
            Self::Object => b'O',
            Self::Room => b'R',
            Self::Floor => b'F',
            Self::Building => b'B',
        }
    }

    const fn from_letter(letter: u8) -> Option<Self> {
        match letter {
            b'O' => Some(Self::Object),
            b'R' => Some(Self::Room),
            b'F' => Some(Self::Floor),
            b'B' => Some(Self::Building),
            _ => None,
        }
    }
}

impl fmt::Display for Layer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Object => "object",
            Self::Room => "room",
            Self::Floor => "floor",
            Self::Building => "building",
        })
    }
}

/// Identifies a node for ever: ids are never used twice. Printed `O17`, `R2`, `F1`, `B1`.
///
/// As a `u64` the ASCII letter of the layer is the top byte and the index the other 56 bits,
/// the form of Spark-DSG's `NodeSymbol`. It exceeds 2⁵³: never take it through a float.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NodeId(u64);

const INDEX_BITS: u32 = 56;

impl NodeId {
    /// Indices reach from 0 to this, which bounds the memory a hostile id can cost.
    pub const MAX_INDEX: u32 = (1 << 24) - 1;

    /// The node of `layer` with `index`; `None` beyond [`NodeId::MAX_INDEX`].
    pub const fn new(layer: Layer, index: u32) -> Option<Self> {
        if index > Self::MAX_INDEX {
            return None;
        }
        Some(Self(((layer.letter() as u64) << INDEX_BITS) | index as u64))
    }

    /// The layer of the node.
    pub const fn layer(self) -> Layer {
        match Layer::from_letter((self.0 >> INDEX_BITS) as u8) {
            Some(layer) => layer,
            None => panic!("a NodeId is only made with a known layer"),
        }
    }

    /// The index within the layer.
    pub const fn index(self) -> u32 {
        self.0 as u32
    }

    /// The 64 bits, as recordings and Spark-DSG store them.
    pub const fn bits(self) -> u64 {
        self.0
    }
}

impl TryFrom<u64> for NodeId {
    type Error = NodeIdError;

    fn try_from(bits: u64) -> Result<Self, NodeIdError> {
        let refused = NodeIdError::Bits { bits };
        let layer = Layer::from_letter((bits >> INDEX_BITS) as u8).ok_or(refused.clone())?;
        let index = u32::try_from(bits & ((1 << INDEX_BITS) - 1)).map_err(|_| refused.clone())?;
        Self::new(layer, index).ok_or(refused)
    }
}

impl fmt::Display for NodeId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", char::from(self.layer().letter()), self.index())
    }
}

impl fmt::Debug for NodeId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl FromStr for NodeId {
    type Err = NodeIdError;

    fn from_str(text: &str) -> Result<Self, NodeIdError> {
        let parsed = || {
            let (&letter, digits) = text.as_bytes().split_first()?;
            if digits.is_empty() || !digits.iter().all(u8::is_ascii_digit) {
                return None;
            }
            Self::new(Layer::from_letter(letter)?, text.get(1..)?.parse().ok()?)
        };
        parsed().ok_or_else(|| NodeIdError::Text { text: text.to_owned() })
    }
}

/// Why something is no node id.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NodeIdError {
    /// Text of another form.
    #[error("{text:?} is not a node id such as O17, R2, F1 or B1 (index up to 16777215)")]
    Text {
        /// What was given.
        text: String,
    },
    /// A number with another letter or too large an index.
    #[error("{bits} is not a node id: its top byte must be O, R, F or B and its index below 2^24")]
    Bits {
        /// What was given.
        bits: u64,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_have_the_bits_of_spark_dsg() {
        let id = NodeId::new(Layer::Room, 0).unwrap();
        assert_eq!(id.bits(), 5_908_722_711_110_090_752); // R(0) of Hydra's apartment
        assert_eq!(NodeId::try_from(4_755_801_206_503_243_776), Ok("B0".parse().unwrap()));
    }

    #[test]
    fn ids_read_back_from_text_and_bits() {
        for text in ["O0", "O17", "R2", "F1", "B16777215"] {
            let id: NodeId = text.parse().unwrap();
            assert_eq!(id.to_string(), text);
            assert_eq!(NodeId::try_from(id.bits()), Ok(id));
        }
    }

    #[test]
    fn other_texts_and_numbers_are_refused() {
        for text in ["", "O", "17", "X1", "O-1", "O+1", "O1x", "O16777216", "O99999999999", "É1"] {
            assert!(text.parse::<NodeId>().is_err(), "{text}");
        }
        for bits in [0, u64::MAX, 0x4f01_0000_0000_0000, 7_000_000_000_000_000_000] {
            assert!(NodeId::try_from(bits).is_err(), "{bits}");
        }
    }
}
