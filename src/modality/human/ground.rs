//! Grounding: which nodes of the graph a reading means, and the claims it comes to.
//!
//! # Policy
//! - Names: the same words first, then synonyms, compounds, kinds, parts; then whatever
//!   [`LabelSimilarity`] finds nearest. Only the closest count.
//! - What is said of where a thing was narrows the candidates down. If none was there, the claim
//!   is rejected: it speaks of another thing than the graph knows. A piece of furniture that the
//!   graph does not know narrows nothing down; a room that it does not know rejects the claim.
//! - A tie is broken by the target (what is there already was not moved there) or by what was
//!   spoken of last, and the reason is recorded; otherwise the claim is rejected as ambiguous,
//!   with a question to ask.
//! - What is put somewhere and known nowhere is new. What is moved or removed must be known.
//! - What is there already, as far as is known, changes nothing.
//! - What was taken to a place outside (the office, a shop), which is no room of the graph, left.

use std::borrow::Cow;
use std::collections::BTreeMap;

use super::find::{Candidate, Finder, LabelSimilarity, closest};
use super::lexicon::lexicon;
use super::names::Closeness;
use super::reading::{Mention, Quantity, Reading, Statement};
use crate::change::{Action, Claim, EvidenceRef, Modality, NodeRef, Occurred, Rejection, World};
use crate::graph::{Label, NodeId, Object};
use crate::time::Stamp;

/// Where something was before it was last moved or removed: its room and support.
pub type Places = BTreeMap<NodeId, (NodeId, Option<NodeId>)>;

/// What grounding goes by besides the graph and the words.
#[derive(Clone, Default)]
pub struct GroundConfig<'a> {
    /// Name and version of the detector that claims.
    pub detector: Cow<'static, str>,
    /// What the claims rest on.
    pub evidence: Vec<EvidenceRef>,
    /// Finds the nearest label where the lexicon knows none.
    pub similarity: Option<&'a dyn LabelSimilarity>,
    /// Where things were before, for what was put back.
    pub places: Places,
    /// What was spoken of last, which breaks ties.
    pub recent: Vec<NodeId>,
}

/// How one mention was understood.
#[derive(Clone, Debug, PartialEq)]
pub struct Resolved {
    /// `object`, `support`, `source` or `target`.
    pub role: &'static str,
    /// The words.
    pub mention: Mention,
    /// Everything the words may mean, closest first.
    pub candidates: Vec<NodeId>,
    /// What they were taken to mean.
    pub chosen: Vec<NodeId>,
    /// Why.
    pub why: String,
}

/// A claim, or one that was rejected before it was planned, and why.
pub type Verdict = Result<Claim, (Claim, Rejection)>;

/// Grounds a whole reading in one world, as if nothing in it changed the world on the way.
pub fn ground(
    world: &World,
    reading: &Reading,
    said_at: Stamp,
    config: &GroundConfig<'_>,
) -> Vec<Verdict> {
    let mut grounding = Grounding::new(world, reading, said_at, config);
    reading.statements.iter().flat_map(|it| grounding.statement(world, it)).collect()
}

/// Grounds the statements of one reading one after the other, while the world changes.
pub struct Grounding<'a> {
    said_at: Stamp,
    config: &'a GroundConfig<'a>,
    finder: Finder<'a>,
    /// What the words at these places were taken to mean.
    meant: BTreeMap<(usize, usize), Vec<NodeId>>,
    /// Where the things were whose places are spoken of, before anything was changed.
    before: BTreeMap<NodeId, (NodeId, Option<NodeId>)>,
    /// How each mention was understood, since the last [`Grounding::take_trail`].
    trail: Vec<Resolved>,
}

/// Why no claim can be made; boxed, for it is large and rare.
type Refusal = Box<Rejection>;

/// Where it is now: a room and perhaps a support, or outside.
enum Target {
    In { room: NodeId, support: Option<NodeId> },
    Outside(String),
    Unsaid,
}

impl<'a> Grounding<'a> {
    /// A grounding of `reading`, which is about `world`.
    pub fn new(world: &World, reading: &Reading, said_at: Stamp, config: &'a GroundConfig<'a>) -> Self {
        let finder = Finder { similarity: config.similarity, guess: false };
        let mut grounding = Self {
            said_at,
            config,
            finder,
            meant: BTreeMap::new(),
            before: BTreeMap::new(),
            trail: Vec::new(),
        };
        for place in reading.statements.iter().filter_map(|it| it.target_room.as_ref()).filter(|it| it.its_place) {
            for id in grounding.find(world, "place of", place, &[], None).unwrap_or_default() {
                if let Some(object) = world.known(id) {
                    grounding.before.insert(id, (object.room, object.support));
                }
            }
        }
        grounding.trail.clear();
        grounding
    }

    /// How the mentions since the last call were understood.
    pub fn take_trail(&mut self) -> Vec<Resolved> {
        std::mem::take(&mut self.trail)
    }

    /// Tells that the words at `span` turned out to mean `id`, for example something new.
    pub fn settle(&mut self, span: Option<(usize, usize)>, id: NodeId) {
        if let Some(span) = span {
            self.meant.entry(span).or_default().push(id);
        }
    }

    /// The claims of one statement.
    pub fn statement(&mut self, world: &World, statement: &Statement) -> Vec<Verdict> {
        match self.claims(world, statement) {
            Ok(claims) => claims.into_iter().map(Ok).collect(),
            Err(rejection) => vec![Err((self.blank(statement), *rejection))],
        }
    }

    fn claims(&mut self, world: &World, statement: &Statement) -> Result<Vec<Claim>, Refusal> {
        match statement.action {
            Action::Removed => self.removed(world, statement),
            Action::Moved => self.moved(world, statement, false),
            Action::Added if !statement.object.definite && statement.object.id.is_none() => self.added(world, statement),
            Action::Added => self.moved(world, statement, true),
        }
    }

    fn removed(&mut self, world: &World, statement: &Statement) -> Result<Vec<Claim>, Refusal> {
        let hints = hints(statement, true);
        let ids = self.find(world, "object", &statement.object, &hints, None)?;
        let claim = |id: &NodeId| Claim { object: node(world, *id), ..self.blank(statement) };
        // Where it was is told by the graph.
        Ok(ids.iter().map(claim).map(|it| Claim { support: None, source_room: None, target_room: None, ..it }).collect())
    }

    fn added(&mut self, world: &World, statement: &Statement) -> Result<Vec<Claim>, Refusal> {
        let target = self.target(world, statement)?;
        let Target::In { room, support } = target else {
            return Err(Box::new(Rejection::NoTarget { object: label_ref(&statement.object) }));
        };
        let novelty = &lexicon().words.novelty;
        let new = statement.object.adjectives.iter().any(|it| novelty.contains(it));
        let count = match statement.object.quantity {
            Quantity::Count(n) => n.min(32) as usize,
            _ => 1,
        };
        let there = self.finder.objects(&statement.object, world.graph().objects());
        let there = closest(&there).into_iter().filter(|it| is_at(world, it.id, room, support)).count();
        if !new && there >= count {
            self.say("object", &statement.object, "it is known to be there already");
            return Ok(Vec::new());
        }
        let missing = if new { count } else { count - there };
        self.say("object", &statement.object, "new to the graph");
        let object = label_ref(&statement.object);
        let claim = Claim {
            object,
            target_room: Some(node(world, room)),
            support: support.map(|id| node(world, id)),
            source_room: None,
            ..self.blank(statement)
        };
        Ok(vec![claim; missing])
    }

    /// Moved, or with `or_new` added if nobody knows it.
    fn moved(&mut self, world: &World, statement: &Statement, or_new: bool) -> Result<Vec<Claim>, Refusal> {
        let target = self.target(world, statement)?;
        if let Target::Outside(why) = &target {
            let gone = Statement { action: Action::Removed, support: None, target_room: None, ..statement.clone() };
            let claims = self.removed(world, &gone)?;
            if let Some(last) = self.trail.last_mut() {
                last.why = format!("{}; {why}", last.why);
            }
            return Ok(claims.into_iter().map(|it| Claim { action: Action::Removed, ..it }).collect());
        }
        let place = match &target {
            Target::In { room, support } => Some((*room, *support)),
            _ => None,
        };
        let hints = hints(statement, false);
        let ids = match self.find(world, "object", &statement.object, &hints, place) {
            Err(refusal) if or_new && matches!(*refusal, Rejection::UnknownObject { .. }) => {
                self.trail.pop();
                return self.added(world, statement);
            }
            found => found?,
        };
        let mut claims = Vec::new();
        for id in ids {
            let (room, support) = match place {
                Some(place) => place,
                None => self.earlier_place(world, statement, id)?,
            };
            if or_new && is_at(world, id, room, support) {
                self.say("object", &statement.object, "it is known to be there already");
                continue;
            }
            claims.push(Claim {
                action: Action::Moved,
                object: node(world, id),
                source_room: None,
                target_room: Some(node(world, room)),
                support: support.map(|id| node(world, id)),
                ..self.blank(statement)
            });
        }
        Ok(claims)
    }

    /// Where `id` was before, if it was put back.
    fn earlier_place(&self, world: &World, statement: &Statement, id: NodeId) -> Result<(NodeId, Option<NodeId>), Refusal> {
        let back = statement.target_room.as_ref().is_some_and(|it| it.its_place);
        let earlier = self.config.places.get(&id).copied();
        let departed = world.departed(id).map(|it| (it.room, it.support));
        let place = departed.or(earlier).filter(|_| back);
        let present = |place: (NodeId, Option<NodeId>)| {
            let support = place.1.filter(|on| world.graph().object(*on).is_some_and(|it| it.room == place.0));
            world.graph().contains(place.0).then_some((place.0, support))
        };
        place.and_then(present).ok_or_else(|| Box::new(Rejection::NoTarget { object: node(world, id) }))
    }

    // ---- where it is now ------------------------------------------------------------------

    fn target(&mut self, world: &World, statement: &Statement) -> Result<Target, Refusal> {
        if let Some(place) = statement.target_room.as_ref().filter(|it| it.its_place) {
            if place.span == statement.object.span && place.noun == statement.object.noun {
                return Ok(Target::Unsaid);
            }
            let ids = self.find(world, "place of", place, &[], None)?;
            let at = ids.first().and_then(|id| self.before.get(id).copied());
            return Ok(at.map_or(Target::Unsaid, |(room, support)| Target::In { room, support }));
        }
        let room = match &statement.target_room {
            Some(mention) => match self.room(world, mention)? {
                Target::In { room, .. } => Some(room),
                outside => return Ok(outside),
            },
            None => None,
        };
        match (&statement.support, room) {
            (Some(support), room) => self.support(world, support, room, statement),
            (None, Some(room)) => Ok(Target::In { room, support: None }),
            (None, None) => Ok(Target::Unsaid),
        }
    }

    /// The room that is named, or that the thing is in by which it is told.
    fn room(&mut self, world: &World, mention: &Mention) -> Result<Target, Refusal> {
        if let Some(id) = chosen_id(mention)? {
            let room = world.graph().object(id).map(|it| it.room).or_else(|| world.graph().region(id).map(|_| id));
            let room = room.ok_or_else(|| Box::new(Rejection::UnknownRoom { wanted: NodeRef::id(id) }))?;
            self.chose("target", mention, vec![room], &[room], "named by id".to_owned());
            return Ok(Target::In { room, support: None });
        }
        let rooms = closest(&self.finder.rooms(mention, world));
        if let Some(room) = self.one_room(world, "target", mention, &rooms)? {
            return Ok(Target::In { room, support: None });
        }
        let near = mention_at(mention);
        match self.find(world, "near", mention, &near, None) {
            Ok(ids) if !ids.is_empty() => {
                let room = ids.first().and_then(|id| world.known(*id)).map(|it| it.room);
                let same = ids.iter().all(|id| world.known(*id).map(|it| it.room) == room);
                match room.filter(|_| same) {
                    Some(room) => Ok(Target::In { room, support: None }),
                    None => Err(Self::which(world, mention, ids)),
                }
            }
            Err(refusal) if !matches!(*refusal, Rejection::UnknownObject { .. }) => Err(refusal),
            _ => self.outside(mention).ok_or_else(|| Box::new(Rejection::UnknownRoom { wanted: label_ref(mention) })),
        }
    }

    fn one_room(&mut self, world: &World, role: &'static str, mention: &Mention, rooms: &[Candidate]) -> Result<Option<NodeId>, Refusal> {
        let ids: Vec<NodeId> = rooms.iter().map(|it| it.id).collect();
        match rooms {
            [] => Ok(None),
            [only] => {
                self.chose(role, mention, ids, &[only.id], only.closeness.words().to_owned());
                Ok(Some(only.id))
            }
            _ => Err(Self::which(world, mention, ids)),
        }
    }

    /// A place that is no part of the home.
    fn outside(&mut self, mention: &Mention) -> Option<Target> {
        let words = &lexicon().words;
        let head = mention.noun.rsplit(' ').next().unwrap_or_default();
        let away = words.away_places.contains(head) || words.away_places.contains(&mention.noun);
        let waste = words.waste.contains(&mention.noun) || words.waste.contains(head);
        let why = format!("{} is no place the graph knows: it left", mention.noun);
        self.say("target", mention, &why);
        (away || waste).then_some(Target::Outside(why))
    }

    fn support(&mut self, world: &World, mention: &Mention, room: Option<NodeId>, statement: &Statement) -> Result<Target, Refusal> {
        let mut hints = mention_at(mention);
        let own = chosen_id(&statement.object).ok().flatten();
        if let Some(room) = room {
            hints.push(Hint::Room(room));
        }
        let found = self.find(world, "support", mention, &hints, None);
        let found = found.map(|ids| ids.into_iter().filter(|id| Some(*id) != own && world.graph().objects().any(|it| it.0 == *id)).collect::<Vec<_>>());
        match (found, room) {
            (Ok(ids), room) if !ids.is_empty() => {
                let around = world.known(ids[0]).map(|it| it.room).or(room);
                let Some(room) = around else { return Ok(Target::Unsaid) };
                let support = (ids.len() == 1).then(|| ids[0]);
                Ok(Target::In { room, support })
            }
            (_, Some(room)) => {
                self.say("support", mention, "its support is not known");
                Ok(Target::In { room, support: None })
            }
            (Err(refusal), None) if !matches!(*refusal, Rejection::UnknownObject { .. }) => {
                self.one_of_several(world, mention, refusal)
            }
            (_, None) => self.support_as_room(world, mention),
        }
    }

    /// One of several supports of one room: the room is known, whichever it is.
    fn one_of_several(&mut self, world: &World, mention: &Mention, refusal: Refusal) -> Result<Target, Refusal> {
        let Rejection::WhichOne { candidates, .. } = &*refusal else { return Err(refusal) };
        let room_of = |id: &NodeId| world.known(*id).map(|it| it.room);
        let room = candidates.first().and_then(room_of);
        match room.filter(|_| candidates.iter().all(|id| room_of(id) == room)) {
            Some(room) => {
                self.say("support", mention, "one of several in the room: which is not known");
                Ok(Target::In { room, support: None })
            }
            None => Err(refusal),
        }
    }

    /// "in the closet" may be a room, or a place outside.
    fn support_as_room(&mut self, world: &World, mention: &Mention) -> Result<Target, Refusal> {
        let rooms = closest(&self.finder.rooms(mention, world));
        if let Some(room) = self.one_room(world, "target", mention, &rooms)? {
            return Ok(Target::In { room, support: None });
        }
        // The room may be in the name: "kitchen windowsill".
        if let Some(room) = self.room_in_name(world, mention) {
            self.say("support", mention, "its support is not known, but the room is named");
            return Ok(Target::In { room, support: None });
        }
        self.outside(mention).ok_or_else(|| Box::new(Rejection::UnknownSupport { wanted: label_ref(mention) }))
    }

    fn room_in_name(&self, world: &World, mention: &Mention) -> Option<NodeId> {
        let words: Vec<&str> = mention.noun.split(' ').collect();
        (1..words.len()).rev().find_map(|n| {
            let prefix = Mention { noun: words[..n].join(" "), ..Mention::default() };
            let rooms = closest(&self.finder.rooms(&prefix, world));
            (rooms.len() == 1).then(|| rooms[0].id)
        })
    }

    // ---- which thing is meant -------------------------------------------------------------

    /// The objects that `mention` means.
    fn find(&mut self, world: &World, role: &'static str, mention: &Mention, hints: &[Hint<'_>], target: Option<(NodeId, Option<NodeId>)>) -> Result<Vec<NodeId>, Refusal> {
        if let Some(id) = chosen_id(mention)? {
            if world.known(id).is_none() {
                return Err(Box::new(Rejection::UnknownObject { wanted: NodeRef::id(id), where_: String::new() }));
            }
            self.check_name(world, mention, id)?;
            self.chose(role, mention, vec![id], &[id], "named by id".to_owned());
            return Ok(vec![id]);
        }
        if let Some(ids) = mention.span.and_then(|span| self.meant.get(&span)).cloned() {
            self.chose(role, mention, ids.clone(), &ids, "the one spoken of before".to_owned());
            return Ok(ids);
        }
        let mut all = self.finder.objects(mention, world.graph().all_objects());
        let absent = all.is_empty();
        if absent {
            all = self.finder.objects(mention, world.all_departed());
        }
        let fitting = self.fitting(world, mention, &all, hints)?;
        let best = closest(&fitting);
        let ids: Vec<NodeId> = best.iter().map(|it| it.id).collect();
        let why = best.first().map_or("", |it| it.closeness.words());
        let chosen = self.choose(world, mention, &ids, hints, target);
        let (chosen, how) = chosen.inspect_err(|_| {
            let candidates = ids.clone();
            self.trail.push(Resolved { role, mention: mention.clone(), candidates, chosen: Vec::new(), why: "several".to_owned() });
        })?;
        self.chose(role, mention, ids, &chosen, format!("{why}{how}"));
        if let Some(span) = mention.span {
            self.meant.insert(span, chosen.clone());
        }
        Ok(chosen)
    }

    /// A reader that chooses an id must call it by a name that it may have.
    fn check_name(&self, world: &World, mention: &Mention, id: NodeId) -> Result<(), Refusal> {
        let (Some(object), Ok(claimed)) = (world.known(id), Label::new(&mention.noun)) else {
            return Ok(());
        };
        let same = object.label.same_class(claimed.as_str());
        let fits = || !self.finder.objects(mention, std::iter::once((id, object))).is_empty();
        if same || fits() {
            return Ok(());
        }
        Err(Box::new(Rejection::Contradiction { id, label: object.label.clone(), claimed }))
    }

    /// Those of `all` that are where the words say.
    fn fitting(&mut self, world: &World, mention: &Mention, all: &[Candidate], hints: &[Hint<'_>]) -> Result<Vec<Candidate>, Refusal> {
        let mut fitting = all.to_vec();
        let wanted = label_ref(mention);
        if fitting.is_empty() {
            self.chose("object", mention, Vec::new(), &[], "nothing of that name is known".to_owned());
            return Err(Box::new(Rejection::UnknownObject { wanted, where_: String::new() }));
        }
        // "the living room lamp" is no lamp of the bedroom; a "kitchen table" may be anywhere.
        let named_by_room = fitting.iter().all(|it| matches!(it.closeness, Closeness::Compound(_)));
        let in_name = self.room_in_name(world, mention).map(Hint::Room);
        for (hint, strict) in hints.iter().map(|it| (it, true)).chain(in_name.iter().map(|it| (it, named_by_room))) {
            let place = self.hint(world, hint)?;
            let narrowed: Vec<Candidate> = fitting.iter().filter(|it| place.holds(world, it.id)).copied().collect();
            let loosely: Vec<Candidate> = fitting.iter().filter(|it| place.may_hold(world, it.id)).copied().collect();
            let narrowed = if narrowed.is_empty() { loosely } else { narrowed };
            if !narrowed.is_empty() {
                fitting = narrowed;
            } else if strict {
                let ids = closest(all).iter().map(|it| it.id).collect::<Vec<_>>();
                let question = format!("I know {} only {}. Is that the one?", mention.noun, place_words(world, ids[0]));
                self.chose("object", mention, ids.clone(), &[], format!("none is {}", place.words(world)));
                return Err(Box::new(Rejection::NotThere { wanted, where_: place.words(world), known: ids, question }));
            }
        }
        Ok(fitting)
    }

    fn hint(&mut self, world: &World, hint: &Hint<'_>) -> Result<HintPlace, Refusal> {
        let mention = match hint {
            Hint::Room(room) => return Ok(HintPlace { rooms: vec![*room], things: Vec::new() }),
            Hint::Words(mention) => *mention,
        };
        if let Some(id) = chosen_id(mention)? {
            let room = id.layer() == crate::graph::Layer::Room;
            let (rooms, things) = if room { (vec![id], vec![]) } else { (vec![], vec![id]) };
            return Ok(HintPlace { rooms, things });
        }
        let ids = |of: &[Candidate]| of.iter().map(|it| it.id).collect::<Vec<_>>();
        let rooms = ids(&closest(&self.finder.rooms(mention, world)));
        let things = ids(&closest(&self.finder.objects(mention, world.graph().objects())));
        let (rooms, things) = if rooms.is_empty() { (rooms, things) } else { (rooms, Vec::new()) };
        self.chose("source", mention, [rooms.clone(), things.clone()].concat(), &[rooms.clone(), things.clone()].concat(), "where it was".to_owned());
        let head = mention.noun.rsplit(' ').next().unwrap_or_default();
        if rooms.is_empty() && things.is_empty() && lexicon().words.rooms.contains(head) {
            return Err(Box::new(Rejection::UnknownRoom { wanted: label_ref(mention) }));
        }
        Ok(HintPlace { rooms, things })
    }

    /// One or as many as were meant of those that answer equally well, and how they were told
    /// apart.
    fn choose(&mut self, world: &World, mention: &Mention, ids: &[NodeId], hints: &[Hint<'_>], target: Option<(NodeId, Option<NodeId>)>) -> Result<(Vec<NodeId>, String), Refusal> {
        let told = if hints.is_empty() { "" } else { ", where it was said to be" };
        match (mention.quantity, ids) {
            (Quantity::All, _) => Ok((ids.to_vec(), format!(", all {} of them", ids.len()))),
            (Quantity::Count(n), _) if n as usize == ids.len() => Ok((ids.to_vec(), format!(", all {n} of them"))),
            (Quantity::Count(n), _) if (n as usize) > ids.len() => {
                let (known, wanted) = (ids.to_vec(), label_ref(mention));
                Err(Box::new(Rejection::TooFew { wanted, said: n, known }))
            }
            (Quantity::One, [only]) => Ok((vec![*only], told.to_owned())),
            (Quantity::Count(n), _) => Self::elsewhere(world, ids, target).filter(|it| it.len() == n as usize)
                .map(|it| (it, ", as the others are there already".to_owned()))
                .ok_or_else(|| Self::which(world, mention, ids.to_vec())),
            (Quantity::One, _) => {
                if let Some(one) = Self::elsewhere(world, ids, target).filter(|it| it.len() == 1) {
                    return Ok((one, ", as the others are there already".to_owned()));
                }
                let recent: Vec<NodeId> = ids.iter().filter(|id| self.config.recent.contains(id)).copied().collect();
                match recent.as_slice() {
                    [one] => Ok((vec![*one], ", the one spoken of last".to_owned())),
                    _ => Err(Self::which(world, mention, ids.to_vec())),
                }
            }
        }
    }

    /// Those that are not at the target yet.
    fn elsewhere(world: &World, ids: &[NodeId], target: Option<(NodeId, Option<NodeId>)>) -> Option<Vec<NodeId>> {
        let (room, support) = target?;
        let away: Vec<NodeId> = ids.iter().filter(|id| !is_at(world, **id, room, support)).copied().collect();
        (away.len() < ids.len()).then_some(away)
    }

    #[allow(clippy::unnecessary_box_returns)] // every refusal is boxed
    fn which(world: &World, mention: &Mention, candidates: Vec<NodeId>) -> Refusal {
        let shown: Vec<String> = candidates.iter().take(4).map(|id| format!("the one {} ({id})", place_words(world, *id))).collect();
        let more = if candidates.len() > 4 { format!(", or one of {} more", candidates.len() - 4) } else { String::new() };
        let question = format!("Which {} do you mean: {}{more}?", mention.noun, shown.join(", or "));
        Box::new(Rejection::WhichOne { wanted: label_ref(mention), candidates, question })
    }

    // ---- claims and the trail -------------------------------------------------------------

    /// The claim with nothing but words in it, as a rejection shows it.
    fn blank(&self, statement: &Statement) -> Claim {
        let maybe = |mention: Option<&Mention>| mention.filter(|it| !it.its_place).map(label_ref);
        Claim {
            modality: Modality::Human,
            detector: self.config.detector.clone(),
            action: statement.action,
            object: label_ref(&statement.object),
            source_room: maybe(statement.source_room.as_ref().or(statement.object.at.first())),
            target_room: maybe(statement.target_room.as_ref()),
            support: maybe(statement.support.as_ref()),
            pose: None,
            size: None,
            confidence: statement.confidence.clamp(0.0, 1.0),
            occurred: self.occurred(statement),
            held: false,
            evidence: self.config.evidence.clone(),
        }
    }

    fn occurred(&self, statement: &Statement) -> Occurred {
        let before = |seconds: f64| {
            let nanos = (seconds.max(0.0) * 1e9) as u64;
            Stamp::from_nanos(self.said_at.nanos().saturating_sub(nanos))
        };
        match statement.when {
            Some(when) => Occurred {
                not_before: Some(before(when.earliest_s)),
                not_after: Some(before(when.latest_s)),
            },
            None => Occurred { not_before: None, not_after: Some(self.said_at) },
        }
    }

    fn say(&mut self, role: &'static str, mention: &Mention, why: &str) {
        self.chose(role, mention, Vec::new(), &[], why.to_owned());
    }

    fn chose(&mut self, role: &'static str, mention: &Mention, candidates: Vec<NodeId>, chosen: &[NodeId], why: String) {
        let chosen = chosen.to_vec();
        self.trail.push(Resolved { role, mention: mention.clone(), candidates, chosen, why });
    }
}

/// What is said of where a thing was.
enum Hint<'a> {
    Words(&'a Mention),
    Room(NodeId),
}

/// A hint, once it is known what it means; empty if nobody knows.
struct HintPlace {
    rooms: Vec<NodeId>,
    things: Vec<NodeId>,
}

impl HintPlace {
    fn holds(&self, world: &World, id: NodeId) -> bool {
        let Some(object) = world.known(id) else { return false };
        if self.rooms.is_empty() && self.things.is_empty() {
            return true;
        }
        self.rooms.contains(&object.room) || self.things.iter().any(|thing| rests_on(world, object, *thing))
    }

    /// By the thing that is named, or on it as far as the graph does not know better.
    fn may_hold(&self, world: &World, id: NodeId) -> bool {
        let Some(object) = world.known(id) else { return false };
        let beside = |thing: &NodeId| *thing != id && world.known(*thing).is_some_and(|it| it.room == object.room);
        object.support.is_none() && self.things.iter().any(beside)
    }

    fn words(&self, world: &World) -> String {
        let named = self.rooms.iter().chain(&self.things).filter_map(|id| world.graph().label(*id));
        let named: Vec<String> = named.take(3).map(ToString::to_string).collect();
        let preposition = if self.rooms.is_empty() { "at" } else { "in" };
        format!("{preposition} the {}", named.join(" or "))
    }
}

fn rests_on(world: &World, object: &Object, on: NodeId) -> bool {
    let mut below = object.support;
    for _ in 0..16 {
        match below {
            Some(id) if id == on => return true,
            Some(id) => below = world.known(id).and_then(|it| it.support),
            None => return false,
        }
    }
    false
}

fn is_at(world: &World, id: NodeId, room: NodeId, support: Option<NodeId>) -> bool {
    let object = world.graph().object(id).filter(|it| !it.is_held());
    object.is_some_and(|it| it.room == room && (support.is_none() || it.support == support))
}

fn hints(statement: &Statement, removal: bool) -> Vec<Hint<'_>> {
    let support = statement.support.as_ref().filter(|_| removal);
    let said = statement.object.at.iter().chain(statement.source_room.as_ref()).chain(support);
    said.filter(|it| !it.its_place).flat_map(|it| std::iter::once(it).chain(&it.at)).map(Hint::Words).collect()
}

fn mention_at(mention: &Mention) -> Vec<Hint<'_>> {
    mention.at.iter().map(Hint::Words).collect()
}

/// The id that the reader itself chose, if any.
fn chosen_id(mention: &Mention) -> Result<Option<NodeId>, Refusal> {
    let unknown = || Box::new(Rejection::UnknownObject { wanted: label_ref(mention), where_: String::new() });
    mention.id.as_ref().map(|id| id.parse().map_err(|_| unknown())).transpose()
}

fn node(world: &World, id: NodeId) -> NodeRef {
    crate::modality::desk::node_ref(world, id)
}

/// The label of something new: its noun, with adjectives that last.
fn label_ref(mention: &Mention) -> NodeRef {
    let words = &lexicon().words;
    let lasting = |it: &&String| words.colours.contains(*it) || matches!(it.as_str(), "wooden" | "plastic" | "metal" | "leather");
    let adjectives = mention.adjectives.iter().filter(lasting).map(String::as_str);
    let text: Vec<&str> = adjectives.chain(std::iter::once(mention.noun.as_str())).collect();
    let text = text.join(" ");
    NodeRef { id: None, label: Label::new(&text).ok() }
}

/// "on the table in the kitchen", of a node.
fn place_words(world: &World, id: NodeId) -> String {
    let Some(object) = world.known(id) else { return format!("called {id}") };
    let named = |preposition: &str, id: NodeId| {
        world.graph().label(id).map(|label| format!("{preposition} the {label}"))
    };
    let on = object.support.and_then(|on| named("on", on));
    let room = named("in", object.room);
    on.into_iter().chain(room).collect::<Vec<_>>().join(" ")
}
