//! Reliability diagrams: what was predicted against what came, as SVG.

use plotters::prelude::*;

use super::raster::FONT;
use crate::learn::Bin;

/// One line of a diagram.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// What it is called.
    pub name: String,
    /// Its bins.
    pub bins: Vec<Bin>,
}

const SIDE: u32 = 640;
/// Colours that people who do not tell red from green tell apart (Okabe and Ito, 2008).
const COLOURS: [RGBColor; 6] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
];

/// Why a diagram was not drawn.
#[derive(Debug, thiserror::Error)]
#[error("the diagram could not be drawn: {0}")]
pub struct DrawError(String);

/// Draws bins of predictions: their mean to the right, the share that came true upwards, a point
/// as large as many predictions it stands for. Who is well calibrated lies on the diagonal.
pub fn svg(title: &str, series: &[Series]) -> Result<String, DrawError> {
    let mut text = String::new();
    draw(&mut text, title, series).map_err(|error| DrawError(error.to_string()))?;
    Ok(text)
}

fn draw(
    text: &mut String,
    title: &str,
    series: &[Series],
) -> Result<(), Box<dyn std::error::Error>> {
    let root = SVGBackend::with_string(text, (SIDE, SIDE)).into_drawing_area();
    root.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(&root)
        .caption(title, (FONT, 22))
        .margin(16)
        .x_label_area_size(44)
        .y_label_area_size(52)
        .build_cartesian_2d(0.0..1.0_f64, 0.0..1.0_f64)?;
    chart
        .configure_mesh()
        .x_desc("predicted: still where it was")
        .y_desc("found there")
        .x_labels(6)
        .y_labels(6)
        .light_line_style(WHITE)
        .label_style((FONT, 15))
        .draw()?;
    chart.draw_series(LineSeries::new([(0.0, 0.0), (1.0, 1.0)], BLACK.mix(0.3)))?;
    for (n, line) in series.iter().enumerate() {
        let colour = COLOURS[n % COLOURS.len()];
        let points: Vec<(f64, f64, u64)> = line.bins.iter().filter_map(point).collect();
        let path = points.iter().map(|(x, y, _)| (*x, *y));
        chart
            .draw_series(LineSeries::new(path, colour.stroke_width(2)))?
            .label(line.name.as_str())
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], colour.stroke_width(2)));
        let total: u64 = points.iter().map(|(_, _, count)| count).sum();
        chart.draw_series(points.iter().map(|(x, y, count)| {
            let share = *count as f64 / total.max(1) as f64;
            Circle::new((*x, *y), 3 + (12.0 * share.sqrt()) as i32, colour.mix(0.7).filled())
        }))?;
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperLeft)
        .background_style(WHITE.mix(0.8))
        .border_style(BLACK.mix(0.2))
        .label_font((FONT, 15))
        .draw()?;
    root.present()?;
    Ok(())
}

fn point(bin: &Bin) -> Option<(f64, f64, u64)> {
    Some((bin.predicted?, bin.observed?, bin.n))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::learn::Tally;

    #[test]
    fn a_diagram_has_a_line_for_each_model_and_becomes_a_picture() {
        let mut tally = Tally::default();
        (0..100).for_each(|n| tally.add(f64::from(n) / 100.0, n % 3 == 0));
        let series = |name: &str| Series { name: name.to_owned(), bins: tally.reliability() };
        let drawing = svg("mugs", &[series("sigmoid"), series("birth-death")]).unwrap();
        assert!(drawing.contains("birth-death") && drawing.contains("mugs"), "{drawing}");
        assert!(super::super::raster::png(&drawing, 320).unwrap().len() > 1000);
        assert_eq!(drawing, svg("mugs", &[series("sigmoid"), series("birth-death")]).unwrap());
    }
}
