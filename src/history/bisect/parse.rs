//! From text to [`Expr`], by recursive descent.

use std::str::FromStr;

use super::expr::{Comparison, Expr, Tally, Test, Who};
use super::scan::Scanner;
use crate::graph::Layer;

/// How deep conditions may be nested, which bounds the stack.
const DEPTH: usize = 64;

/// All words that begin a test.
const TESTS: [&str; 10] = [
    "present",
    "absent",
    "held",
    "in",
    "on",
    "count",
    "probability",
    "objects",
    "rooms",
    "changes",
];

/// Why a text is no condition.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("column {column} of the condition: {problem}")]
pub struct ParseError {
    /// Where, in characters from 1.
    pub column: usize,
    /// What was expected, and what came instead.
    pub problem: String,
}

impl FromStr for Expr {
    type Err = ParseError;

    fn from_str(text: &str) -> Result<Self, ParseError> {
        let mut parser = Parser { scan: Scanner::new(text), depth: 0 };
        let expr = parser.expr()?;
        parser.scan.skip_space();
        if parser.scan.at_end() {
            return Ok(expr);
        }
        Err(parser.expected("`and`, `or` or the end"))
    }
}

struct Parser<'a> {
    scan: Scanner<'a>,
    depth: usize,
}

type MakeComparison = fn(f64) -> Comparison;
type Parsed<T> = Result<T, ParseError>;

impl Parser<'_> {
    fn expr(&mut self) -> Parsed<Expr> {
        let mut parts = vec![self.all()?];
        while self.scan.sign("||") || self.scan.keyword("or") {
            parts.push(self.all()?);
        }
        Ok(if parts.len() == 1 { parts.swap_remove(0) } else { Expr::Any(parts) })
    }

    fn all(&mut self) -> Parsed<Expr> {
        let mut parts = vec![self.negation()?];
        while self.scan.sign("&&") || self.scan.keyword("and") {
            parts.push(self.negation()?);
        }
        Ok(if parts.len() == 1 { parts.swap_remove(0) } else { Expr::All(parts) })
    }

    fn negation(&mut self) -> Parsed<Expr> {
        let mut negative = false;
        while self.scan.sign("!") || self.scan.keyword("not") {
            negative = !negative;
        }
        let atom = self.atom()?;
        Ok(if negative { Expr::Not(Box::new(atom)) } else { atom })
    }

    fn atom(&mut self) -> Parsed<Expr> {
        let before = self.scan.clone();
        if !self.scan.sign("(") {
            return self.test().map(Expr::Test);
        }
        self.depth += 1;
        if self.depth > DEPTH {
            self.scan = before;
            return Err(self.problem(format!("parentheses are nested deeper than {DEPTH}")));
        }
        let inner = self.expr()?;
        self.close("`and`, `or` or `)`")?;
        self.depth -= 1;
        Ok(inner)
    }

    fn test(&mut self) -> Parsed<Test> {
        self.scan.skip_space();
        let before = self.scan.clone();
        let word = self.scan.word().to_lowercase();
        Ok(match word.as_str() {
            "present" => Test::Present(self.one_thing()?),
            "absent" => Test::Absent(self.one_thing()?),
            "held" => Test::Held(self.one_thing()?),
            "in" => {
                let thing = self.open_thing()?;
                self.comma()?;
                let place = self.place()?;
                self.close("`)`")?;
                Test::In(thing, place)
            }
            "on" => {
                let thing = self.open_thing()?;
                self.comma()?;
                let support = self.thing()?;
                self.close("`)`")?;
                Test::On(thing, support)
            }
            "count" => Test::Count(self.one_thing()?, self.comparison()?),
            "probability" => Test::Probability(self.one_thing()?, self.comparison()?),
            "objects" => Test::Tally(Tally::Objects, self.comparison()?),
            "rooms" => Test::Tally(Tally::Rooms, self.comparison()?),
            "changes" => Test::Tally(Tally::Changes, self.comparison()?),
            _ => {
                self.scan = before;
                return Err(self.unknown_test(&word));
            }
        })
    }

    fn one_thing(&mut self) -> Parsed<Who> {
        let thing = self.open_thing()?;
        self.close("`)`")?;
        Ok(thing)
    }

    fn open_thing(&mut self) -> Parsed<Who> {
        if !self.scan.sign("(") {
            return Err(self.expected("`(`"));
        }
        self.thing()
    }

    fn thing(&mut self) -> Parsed<Who> {
        let before = self.scan.clone();
        let who = self.who("an object's id or label")?;
        match &who {
            Who::Id(id) if id.layer() != Layer::Object => {
                self.scan = before;
                Err(self.problem(format!("expected an object, but {id} is a {}", id.layer())))
            }
            _ => Ok(who),
        }
    }

    fn place(&mut self) -> Parsed<Who> {
        let before = self.scan.clone();
        let who = self.who("a room's id or label")?;
        match &who {
            Who::Id(id) if id.layer() == Layer::Object => {
                self.scan = before;
                Err(self.problem(format!("expected a room, but {id} is an object: use on(…)")))
            }
            _ => Ok(who),
        }
    }

    /// A name: in quotes, or everything up to a comma or parenthesis.
    fn who(&mut self, what: &str) -> Parsed<Who> {
        self.scan.skip_space();
        let before = self.scan.clone();
        if self.scan.sign("\"") {
            let text = self.scan.take_while(|c| c != '"').to_owned();
            if !self.scan.sign("\"") {
                self.scan = before;
                return Err(self.problem("the quote is not closed".to_owned()));
            }
            return Ok(Who::Label(text));
        }
        let text = self.scan.take_while(|c| !matches!(c, ',' | '(' | ')' | '"')).trim();
        if text.is_empty() {
            self.scan = before;
            return Err(self.expected(what));
        }
        Ok(text.parse().map_or_else(|_| Who::Label(text.to_owned()), Who::Id))
    }

    fn comma(&mut self) -> Parsed<()> {
        if self.scan.sign(",") { Ok(()) } else { Err(self.expected("`,`")) }
    }

    fn close(&mut self, wanted: &str) -> Parsed<()> {
        if self.scan.sign(")") { Ok(()) } else { Err(self.expected(wanted)) }
    }

    fn comparison(&mut self) -> Parsed<Comparison> {
        // Longer signs first: each is a prefix of none after it.
        const SIGNS: [(&str, MakeComparison); 7] = [
            ("<=", Comparison::AtMost),
            (">=", Comparison::AtLeast),
            ("==", Comparison::Equal),
            ("!=", Comparison::Unequal),
            ("<", Comparison::Less),
            (">", Comparison::More),
            ("=", Comparison::Equal),
        ];
        for (sign, make) in SIGNS {
            if self.scan.sign(sign) {
                return self.number().map(make);
            }
        }
        Err(self.expected("a comparison (<, <=, >, >=, = or !=)"))
    }

    fn number(&mut self) -> Parsed<f64> {
        self.scan.skip_space();
        let before = self.scan.clone();
        let digits = self.scan.take_while(|c| c.is_ascii_digit() || c == '.');
        match digits.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => {
                self.scan = before;
                Err(self.expected("a number such as 3 or 0.5"))
            }
        }
    }

    fn unknown_test(&self, word: &str) -> ParseError {
        if word.is_empty() {
            return self.expected("a test such as absent(mug), or `(`");
        }
        let close = similar::get_close_matches(word, &TESTS, 1, 0.7);
        let hint = close.first().map_or_else(
            || format!("the tests are {}", TESTS.join(", ")),
            |test| format!("did you mean `{test}`?"),
        );
        self.problem(format!("there is no test `{word}`; {hint}"))
    }

    fn expected(&self, what: &str) -> ParseError {
        let mut scan = self.scan.clone();
        scan.skip_space();
        let found = match scan.rest().chars().next() {
            None => "the condition ends".to_owned(),
            Some(c) => format!("{c:?} comes"),
        };
        let problem = format!("expected {what}, but {found}");
        ParseError { column: scan.column(), problem }
    }

    fn problem(&self, problem: String) -> ParseError {
        ParseError { column: self.scan.column(), problem }
    }
}
