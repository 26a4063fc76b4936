//! Finding the next intact record after damage.
//!
//! Only records that check themselves are believed: chunks, message indexes, metadata and
//! attachments, whose inner lengths agree with the outer one, and the end of the data section.
//! Plain messages, schemas and channels also occur inside stored chunks, so they count only in
//! a file that has messages outside chunks, and there only three in a row.

use std::io;

use mcap::records::op;

use super::examine::{Content, Examiner};
use super::wire::{self, FRAME};

/// Records in a row that make loose records believable.
const IN_A_ROW: usize = 3;
/// Bytes looked at in one go.
const STRIDE: usize = 8 << 10;

impl Examiner<'_> {
    /// Returns the offset of the first believable record from `from` on, or the end.
    pub(super) fn resync(&mut self, from: u64, loose: bool) -> io::Result<u64> {
        let known = self.resynced[usize::from(loose)];
        if let Some((_, found)) = known.filter(|(asked, found)| (*asked..=*found).contains(&from)) {
            return Ok(found);
        }
        let found = self.search(from, loose)?;
        self.resynced[usize::from(loose)] = Some((from, found));
        Ok(found)
    }

    fn search(&mut self, from: u64, loose: bool) -> io::Result<u64> {
        let mut at = from;
        while at < self.until {
            let left = usize::try_from(self.until - at).unwrap_or(usize::MAX);
            let bytes = self.window.peek(at, STRIDE.min(left))?;
            let Some(skip) = bytes.windows(FRAME as usize).position(|at| is_candidate(at, loose))
            else {
                let seen = bytes.len().saturating_sub(FRAME as usize - 1).max(1);
                at += seen as u64;
                continue;
            };
            at += skip as u64;
            if self.is_anchor(at, loose)? {
                return Ok(at);
            }
            at += 1;
        }
        Ok(self.until)
    }

    fn is_anchor(&mut self, offset: u64, loose: bool) -> io::Result<bool> {
        let Ok(frame) = self.frame(offset)? else { return Ok(false) };
        match frame.opcode {
            op::MESSAGE | op::SCHEMA | op::CHANNEL => return self.is_row(offset, loose),
            op::METADATA if !self.afford(frame.body_len) => return Ok(false),
            // Zeros make an empty message index too easily.
            op::MESSAGE_INDEX if frame.body_len < 22 => return Ok(false),
            op::DATA_END if frame.body_len != 4 => return Ok(false),
            op::FOOTER if frame.body_len != 20 => return Ok(false),
            _ => {}
        }
        let Ok(content) = self.content(frame)? else { return Ok(false) };
        Ok(matches!(content, Content::Chunk(_)) || self.plausible(frame.end())?)
    }

    fn is_row(&mut self, offset: u64, loose: bool) -> io::Result<bool> {
        let mut at = offset;
        for _ in 0..IN_A_ROW {
            if !loose || at == self.until {
                return Ok(loose);
            }
            let Ok(frame) = self.frame(at)? else { return Ok(false) };
            if !self.afford(frame.body_len) || self.content(frame)?.is_err() {
                return Ok(false);
            }
            at = frame.end();
        }
        self.plausible(at)
    }

    fn afford(&mut self, bytes: u64) -> bool {
        let left = self.resync_budget.checked_sub(bytes);
        self.resync_budget = left.unwrap_or(self.resync_budget);
        left.is_some()
    }
}

/// A cheap look at nine bytes: a record type worth a closer look and a length below 4 GiB.
fn is_candidate(bytes: &[u8], loose: bool) -> bool {
    let anchors = match bytes[0] {
        op::CHUNK
        | op::MESSAGE_INDEX
        | op::METADATA
        | op::DATA_END
        | op::FOOTER
        | op::ATTACHMENT => true,
        op::MESSAGE | op::SCHEMA | op::CHANNEL => loose,
        _ => false,
    };
    anchors && wire::frame(bytes).is_some_and(|(_, length)| length < 1 << 32)
}
