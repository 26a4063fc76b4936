//! Putting back what was seen to be allowed before: states that were stored, and edits undone.

use super::{GraphError, NodeId, Object, Placement, SceneGraph};

impl SceneGraph {
    /// Puts an object back to where it was before edits that have been taken back since: that
    /// state was allowed, so nothing is refused.
    pub(crate) fn put_back(&mut self, id: NodeId, placement: &Placement) {
        self.put_at(id, placement);
    }

    /// As [`Self::put_back`], for an object that was replaced.
    pub(crate) fn put_back_over(&mut self, id: NodeId, object: Object) {
        self.put_over(id, object);
    }

    /// As [`Self::put_back`], for an object that was taken out.
    pub(crate) fn put_back_in(&mut self, id: NodeId, object: Object) {
        self.put_in(id, object);
    }

    /// Puts objects that rest on nothing yet on their supports, all at once, so that a pile may
    /// come in any order. On error the graph is half done and of no use.
    pub(crate) fn set_supports(
        &mut self,
        supports: &[(NodeId, NodeId)],
    ) -> Result<(), GraphError> {
        for (id, support) in supports {
            let held = self.object_slot(*id)?.object.is_held();
            self.check_holds(*support, held)?;
            let slot = self.objects.get_mut(id.index()).expect("just read");
            slot.object.support = Some(*support);
            let on = self.objects.get_mut(support.index()).expect("just seen to be there");
            *on.count(held) += 1;
        }
        self.check_acyclic(supports)
    }

    /// Each object is passed once: what is known to stand on the ground ends a way down.
    fn check_acyclic(&self, supports: &[(NodeId, NodeId)]) -> Result<(), GraphError> {
        let mut passed = vec![0_u32; self.objects.places()];
        for (n, (id, support)) in (1..).zip(supports) {
            let mut below = Some(*id);
            while let Some(next) = below {
                let place = self.objects.place(next.index()).expect("supports are there");
                match passed[place] {
                    0 => passed[place] = n,
                    mark if mark == n => {
                        return Err(GraphError::SupportCycle { id: *id, support: *support });
                    }
                    _ => break,
                }
                below = self.object(next).and_then(|object| object.support);
            }
        }
        Ok(())
    }
}
