//! [`Labels`]: labels read before, so that the same few are not made anew for every node.

use super::WireError;
use super::common::read_label;
use super::fields::Field;
use crate::graph::Label;

/// How many labels are remembered at most; a power of two.
const SLOTS: usize = 256;

/// Labels that were read before. Some are forgotten where two would take the same slot.
#[derive(Debug, Default)]
pub struct Labels(Vec<Option<Label>>);

impl Labels {
    /// As [`read_label`], but without a new allocation for a label that is remembered.
    pub(super) fn read(
        &mut self,
        field: &Field<'_>,
        message: &'static str,
    ) -> Result<Label, WireError> {
        let text = field.text("label")?;
        self.0.resize(SLOTS, None);
        let slot = &mut self.0[slot_of(text)];
        match slot {
            Some(known) if known.as_str() == text => Ok(known.clone()),
            _ => Ok(slot.insert(read_label(field, message)?).clone()),
        }
    }
}

/// By the end of the text, where labels of one kind differ (FNV-1a).
fn slot_of(text: &str) -> usize {
    let end = text.as_bytes().iter().rev().take(8);
    let hash = end.fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3)
    });
    hash as usize % SLOTS
}
