//! A writer of SVG: [`Svg`].
//!
//! Numbers have at most two decimals, so that the text is short and the same on every machine.

use std::fmt::{Display, Write};

use super::raster::FONT;

/// A drawing that is being written; lengths are in units of its view box, y down.
#[derive(Clone, Debug)]
pub struct Svg {
    text: String,
    open: usize,
}

/// How a shape looks: attributes of SVG, written in the order in which they are set.
#[derive(Clone, Debug, Default)]
pub struct Look(String);

impl Look {
    /// Filled with a colour, without an outline.
    pub fn fill(colour: &str) -> Self {
        Self::default().with("fill", colour)
    }

    /// An outline of a colour and a width, not filled.
    pub fn line(colour: &str, width: f64) -> Self {
        Self::fill("none").outlined(colour, width)
    }

    /// And with an outline.
    pub fn outlined(self, colour: &str, width: f64) -> Self {
        self.with("stroke", colour).with("stroke-width", number(width))
    }

    /// And dashed: lengths of dashes and gaps.
    pub fn dashed(self, pattern: &str) -> Self {
        self.with("stroke-dasharray", pattern)
    }

    /// And with any other attribute of SVG.
    pub fn with(mut self, name: &str, value: impl Display) -> Self {
        let _ = write!(self.0, " {name}=\"{}\"", escaped(&value.to_string()));
        self
    }
}

/// Where a text stands relative to its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// To the right of it.
    Start,
    /// Around it.
    Middle,
    /// To the left of it.
    End,
}

impl Anchor {
    const fn as_str(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::Middle => "middle",
            Self::End => "end",
        }
    }
}

impl Svg {
    /// An empty drawing on white.
    pub fn new(width: f64, height: f64) -> Self {
        let (w, h) = (number(width), number(height));
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}\" height=\"{h}\" \
             viewBox=\"0 0 {w} {h}\" font-family=\"{FONT}, 'Segoe UI', Helvetica, sans-serif\">\n"
        );
        let mut svg = Self { text, open: 0 };
        svg.rect([0.0, 0.0], [width, height], &Look::fill("#ffffff"));
        svg
    }

    /// A definition or any other element, as it is: the caller vouches for it.
    pub fn raw(&mut self, element: &str) {
        self.text.push_str(element);
        self.text.push('\n');
    }

    /// Begins a group with a look that its members inherit.
    pub fn begin(&mut self, look: &Look) {
        self.raw(&format!("<g{}>", look.0));
        self.open += 1;
    }

    /// Ends the group begun last.
    pub fn end(&mut self) {
        if self.open > 0 {
            self.open -= 1;
            self.raw("</g>");
        }
    }

    /// A rectangle from its upper left corner.
    pub fn rect(&mut self, [x, y]: [f64; 2], [w, h]: [f64; 2], look: &Look) {
        let (x, y, w, h) = (number(x), number(y), number(w), number(h));
        self.raw(&format!("<rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\"{}/>", look.0));
    }

    /// A circle.
    pub fn circle(&mut self, [x, y]: [f64; 2], radius: f64, look: &Look) {
        let (x, y, r) = (number(x), number(y), number(radius));
        self.raw(&format!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\"{}/>", look.0));
    }

    /// A line between two points.
    pub fn segment(&mut self, from: [f64; 2], to: [f64; 2], look: &Look) {
        self.polyline(&[from, to], look);
    }

    /// A line through points.
    pub fn polyline(&mut self, points: &[[f64; 2]], look: &Look) {
        self.raw(&format!("<polyline points=\"{}\"{}/>", list(points), look.0));
    }

    /// A closed polygon.
    pub fn polygon(&mut self, points: &[[f64; 2]], look: &Look) {
        self.raw(&format!("<polygon points=\"{}\"{}/>", list(points), look.0));
    }

    /// A path in SVG's own words.
    pub fn path(&mut self, d: &str, look: &Look) {
        self.raw(&format!("<path d=\"{d}\"{}/>", look.0));
    }

    /// A text whose baseline is at a point.
    pub fn text(&mut self, [x, y]: [f64; 2], size: f64, anchor: Anchor, text: &str, look: &Look) {
        let (x, y, size) = (number(x), number(y), number(size));
        let (anchor, text) = (anchor.as_str(), escaped(text));
        self.raw(&format!(
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" text-anchor=\"{anchor}\"{}>{text}</text>",
            look.0
        ));
    }

    /// The drawing as a document.
    pub fn finish(mut self) -> String {
        while self.open > 0 {
            self.end();
        }
        self.text.push_str("</svg>\n");
        self.text
    }
}

/// A number with at most two decimals and no needless zeros.
pub fn number(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// How wide a text is in the embedded font, in units of its size; within some per cent.
pub fn text_width(text: &str) -> f64 {
    text.chars().map(advance).sum()
}

fn advance(c: char) -> f64 {
    match c {
        'i' | 'j' | 'l' | 'I' | '.' | ',' | '\'' | ':' | ';' | '|' | '!' | ' ' => 0.24,
        'f' | 't' | 'r' | '(' | ')' | '-' | '/' => 0.36,
        'm' | 'w' | 'M' | 'W' | '%' => 0.84,
        'a' | 'c' | 'e' | 'g' | 'k' | 's' | 'v' | 'x' | 'y' | 'z' => 0.51,
        c if c.is_ascii_uppercase() => 0.66,
        c if c.is_ascii() => 0.57,
        _ => 0.8,
    }
}

fn list(points: &[[f64; 2]]) -> String {
    let point = |[x, y]: &[f64; 2]| format!("{},{}", number(*x), number(*y));
    points.iter().map(point).collect::<Vec<_>>().join(" ")
}

/// `text` as XML has it, without characters that XML cannot hold.
fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => safe.push('\u{fffd}'),
            c => safe.push(c),
        }
    }
    safe
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::raster::png;

    #[test]
    fn numbers_are_short() {
        for (value, text) in [(1.0, "1"), (0.125, "0.12"), (-0.001, "0"), (10.5, "10.5")] {
            assert_eq!(number(value), text);
        }
    }

    #[test]
    fn any_text_gives_a_drawing() {
        for text in ["a<b>&\"c'", "\u{0}\u{1b}[31m", "名前 é", "]]>"] {
            let mut svg = Svg::new(40.0, 20.0);
            svg.begin(&Look::fill(text));
            svg.text([2.0, 10.0], 8.0, Anchor::Start, text, &Look::default());
            assert!(png(&svg.finish(), 40).is_ok(), "{text:?}");
        }
    }
}
