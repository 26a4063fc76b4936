//! [`Expr`]: a condition on a world, as a tree.

use std::fmt;

use crate::change::World;
use crate::graph::{Label, Layer, NodeId};

/// A condition on a world at a moment. See the module docs for its text form.
#[derive(Clone, Debug, PartialEq)]
pub enum Expr {
    /// A single test.
    Test(Test),
    /// It does not hold.
    Not(Box<Self>),
    /// All of them hold.
    All(Vec<Self>),
    /// At least one of them holds.
    Any(Vec<Self>),
}

/// One test of a world.
#[derive(Clone, Debug, PartialEq)]
pub enum Test {
    /// Some of them are there.
    Present(Who),
    /// Some that were known are not there now.
    Absent(Who),
    /// Some are in the gripper.
    Held(Who),
    /// Some are in the region.
    In(Who, Who),
    /// Some rest on the other thing.
    On(Who, Who),
    /// How many are there.
    Count(Who, Comparison),
    /// How likely some of them are still where they were last seen.
    Probability(Who, Comparison),
    /// A number of the whole world.
    Tally(Tally, Comparison),
}

/// Names nodes: one by its id, all of a class by their label.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Who {
    /// By id.
    Id(NodeId),
    /// By label.
    Label(String),
}

impl Who {
    /// Whether the node with this id and label is meant.
    pub fn means(&self, id: NodeId, label: &Label) -> bool {
        match self {
            Self::Id(own) => *own == id,
            Self::Label(text) => label.same_class(text),
        }
    }
}

impl Expr {
    /// The names in it that nothing in `world` answers to, there or gone.
    pub fn unknown_names(&self, world: &World) -> Vec<&Who> {
        let graph = world.graph();
        let objects = graph.all_objects().chain(world.all_departed()).map(|(id, o)| (id, &o.label));
        let regions = Layer::ALL.into_iter().flat_map(|layer| graph.regions(layer));
        let known: Vec<(NodeId, &Label)> =
            objects.chain(regions.map(|(id, region)| (id, &region.label))).collect();
        let mut names = self.names();
        names.retain(|who| !known.iter().any(|(id, label)| who.means(*id, label)));
        names
    }

    fn names(&self) -> Vec<&Who> {
        match self {
            Self::Not(inner) => inner.names(),
            Self::All(parts) | Self::Any(parts) => parts.iter().flat_map(Self::names).collect(),
            Self::Test(test) => match test {
                Test::Present(who)
                | Test::Absent(who)
                | Test::Held(who)
                | Test::Count(who, _)
                | Test::Probability(who, _) => vec![who],
                Test::In(who, place) | Test::On(who, place) => vec![who, place],
                Test::Tally(..) => vec![],
            },
        }
    }
}

/// Numbers of a whole world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tally {
    /// Objects in the graph, those in the gripper included.
    Objects,
    /// Rooms in the graph.
    Rooms,
    /// Changes that were applied so far.
    Changes,
}

/// A comparison with a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Comparison {
    /// `<`
    Less(f64),
    /// `<=`
    AtMost(f64),
    /// `>`
    More(f64),
    /// `>=`
    AtLeast(f64),
    /// `=`
    Equal(f64),
    /// `!=`
    Unequal(f64),
}

impl Comparison {
    /// Whether `value` passes.
    #[expect(clippy::float_cmp, reason = "counts are whole; a probability is asked for as given")]
    pub fn holds(self, value: f64) -> bool {
        match self {
            Self::Less(limit) => value < limit,
            Self::AtMost(limit) => value <= limit,
            Self::More(limit) => value > limit,
            Self::AtLeast(limit) => value >= limit,
            Self::Equal(limit) => value == limit,
            Self::Unequal(limit) => value != limit,
        }
    }
}

/// The text form, with every parenthesis: it reads back as the same condition.
impl fmt::Display for Expr {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut joined = |word: &str, parts: &[Self]| {
            f.write_str("(")?;
            for (n, part) in parts.iter().enumerate() {
                if n > 0 {
                    write!(f, " {word} ")?;
                }
                write!(f, "{part}")?;
            }
            f.write_str(")")
        };
        match self {
            Self::Test(test) => write!(f, "{test}"),
            Self::Not(inner) => write!(f, "not {inner}"),
            Self::All(parts) => joined("and", parts),
            Self::Any(parts) => joined("or", parts),
        }
    }
}

impl fmt::Display for Test {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Present(who) => write!(f, "present({who})"),
            Self::Absent(who) => write!(f, "absent({who})"),
            Self::Held(who) => write!(f, "held({who})"),
            Self::In(who, region) => write!(f, "in({who}, {region})"),
            Self::On(who, support) => write!(f, "on({who}, {support})"),
            Self::Count(who, comparison) => write!(f, "count({who}) {comparison}"),
            Self::Probability(who, comparison) => write!(f, "probability({who}) {comparison}"),
            Self::Tally(tally, comparison) => write!(f, "{} {comparison}", tally.as_str()),
        }
    }
}

impl Tally {
    /// The word for it.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Objects => "objects",
            Self::Rooms => "rooms",
            Self::Changes => "changes",
        }
    }
}

/// An id as it is, a label in quotes.
impl fmt::Display for Who {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Id(id) => write!(f, "{id}"),
            Self::Label(label) => write!(f, "\"{label}\""),
        }
    }
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Less(limit) => write!(f, "< {limit}"),
            Self::AtMost(limit) => write!(f, "<= {limit}"),
            Self::More(limit) => write!(f, "> {limit}"),
            Self::AtLeast(limit) => write!(f, ">= {limit}"),
            Self::Equal(limit) => write!(f, "= {limit}"),
            Self::Unequal(limit) => write!(f, "!= {limit}"),
        }
    }
}
