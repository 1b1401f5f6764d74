//! What the page's script draws: the points of a chart, thinned, as compact JSON beside the static picture.

use std::collections::BTreeSet;

use answer::{Numbers, shown_units};
use serde::Serialize;

use super::curve::{BARS, COLOURS, Curve, colour_of};

/// Places on the abscissa at most; of a longer record each stretch keeps the least and the largest value of every
/// curve.
const PLACES: usize = 6000;
/// Digits of ordinates and of abscissae: a long record has close neighbours.
const DIGITS: [usize; 2] = [6, 9];

/// How points are to be joined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Lines over an abscissa that all curves share.
    Lines,
    /// A stick from zero to each value.
    Sticks,
    /// A bar from zero to each value.
    Bars,
    /// One curve that may turn back.
    Path,
    /// A dot for each point, curve by curve with an abscissa of its own.
    Dots,
}

/// A chart as the script takes it; `data` are the abscissa and, curve by curve, the ordinates; of dots abscissa and
/// ordinate in turn.
#[derive(Debug, Serialize)]
pub struct Plot {
    kind: Kind,
    title: String,
    x: String,
    y: String,
    zero: bool,
    /// Whether the area between the second and the third curve is filled.
    band: bool,
    names: Vec<String>,
    colours: Vec<String>,
    data: Vec<Numbers>,
}

impl Plot {
    /// Curves over one pair of axes; the value axis begins at zero if `zero`. A single curve that goes to and fro along
    /// the abscissa is a path.
    pub fn new(title: &str, x: &str, y: &str, curves: &[Curve], zero: bool) -> Self {
        let ascending: Option<Vec<Vec<(f64, f64)>>> = curves.iter().map(|c| ascending(&c.points)).collect();
        let (kind, columns) = match ascending {
            Some(curves) => (Kind::Lines, thinned(shared(curves))),
            None => (Kind::Path, path(curves)),
        };
        Self::of(kind, [title, x, y], curves, zero, columns)
    }

    /// A curve, and the upper and the lower edge of the band around it.
    pub fn banded(title: &str, x: &str, y: &str, curves: &[Curve]) -> Self {
        let plot = Self::new(title, x, y, curves, false);
        // A path has one curve alone.
        Self { band: plot.kind == Kind::Lines && curves.len() == 3, ..plot }
    }

    /// One curve of sticks, or of bars where they are few.
    pub fn sticks(title: &str, x: &str, y: &str, curve: &Curve) -> Self {
        // Of many lines side by side the highest one.
        let stretches = curve.points.chunks(curve.points.len().div_ceil(PLACES).max(1));
        let highest = stretches.filter_map(|part| part.iter().copied().max_by(|a, b| a.1.total_cmp(&b.1)));
        let (at, height) = highest.unzip();
        let kind = if curve.points.len() <= BARS { Kind::Bars } else { Kind::Sticks };
        Self::of(kind, [title, x, y], std::slice::from_ref(curve), true, vec![at, height])
    }

    /// A dot for each point.
    pub fn dots(title: &str, x: &str, y: &str, curves: &[Curve]) -> Self {
        let columns = curves.iter().flat_map(|curve| path(std::slice::from_ref(curve))).collect();
        Self::of(Kind::Dots, [title, x, y], curves, false, columns)
    }

    fn of(kind: Kind, words: [&str; 3], curves: &[Curve], zero: bool, columns: Vec<Vec<f64>>) -> Self {
        let labels = || curves.iter().map(|c| c.label.as_str());
        let colours = (0..curves.len()).map(|k| colour(colour_of(labels(), k))).collect();
        let names = labels().map(str::to_owned).collect();
        let [title, x, y] = words.map(shown_units);
        let digits = |k: usize| DIGITS[usize::from(k == 0 || matches!(kind, Kind::Path | Kind::Dots))];
        let data = columns.into_iter().enumerate().map(|(k, c)| Numbers(c, digits(k))).collect();
        Self { kind, title, x, y, zero, band: false, names, colours, data }
    }
}

/// A colour of the palette as the page writes it.
pub fn colour(k: usize) -> String {
    let plotters::style::RGBColor(r, g, b) = COLOURS[k % COLOURS.len()];
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// JSON for the script, to be put into a page as it is: nothing in it can end the element that holds it.
pub fn embedded(class: &str, data: &impl Serialize) -> String {
    // Numbers, and texts of this program: JSON refuses none of them.
    let json = answer::json(data).unwrap_or_default().replace('<', "\\u003c");
    format!("<script type=\"application/json\" class=\"{class}\">{json}</script>")
}

/// Points with ascending abscissa; `None` where they turn back.
fn ascending(points: &[(f64, f64)]) -> Option<Vec<(f64, f64)>> {
    let mut points: Vec<(f64, f64)> = points.iter().copied().filter(|p| p.0.is_finite()).collect();
    if points.windows(2).all(|w| w[0].0 >= w[1].0) {
        points.reverse();
    }
    points.windows(2).all(|w| w[0].0 <= w[1].0).then_some(points)
}

/// One abscissa for all curves, then their ordinates; NaN where a curve has no point.
fn shared(mut curves: Vec<Vec<(f64, f64)>>) -> Vec<Vec<f64>> {
    let same = |c: &Vec<(f64, f64)>| c.len() == curves[0].len() && c.iter().zip(&curves[0]).all(|(a, b)| a.0 == b.0);
    if curves.iter().all(same) {
        let abscissa = curves.first().map(|c| c.iter().map(|p| p.0).collect()).unwrap_or_default();
        let ordinates = curves.iter_mut().map(|c| std::mem::take(c).into_iter().map(|p| p.1).collect());
        return std::iter::once(abscissa).chain(ordinates).collect();
    }
    let mut all: Vec<f64> = curves.iter().flatten().map(|p| p.0).collect();
    all.sort_by(f64::total_cmp);
    all.dedup();
    let ordinates = curves.iter().map(|curve| {
        let mut column = vec![f64::NAN; all.len()];
        for &(x, y) in curve {
            let at = all.partition_point(|&other| other < x);
            column[at] = y;
        }
        column
    });
    let ordinates: Vec<Vec<f64>> = ordinates.collect();
    std::iter::once(all).chain(ordinates).collect()
}

/// Rows of a long record that keep its envelope: of each stretch those with the least and the largest value of every
/// curve.
fn thinned(columns: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let (rows, curves) = (columns.first().map_or(0, Vec::len), columns.len().saturating_sub(1));
    if rows <= PLACES || curves == 0 {
        return columns;
    }
    let stretch = rows.div_ceil(PLACES / (2 * curves));
    let mut kept = BTreeSet::from([0, rows - 1]);
    for from in (0..rows).step_by(stretch) {
        for column in &columns[1..] {
            let part = || (from..(from + stretch).min(rows)).filter(|&i| column[i].is_finite());
            kept.extend(part().min_by(|&a, &b| column[a].total_cmp(&column[b])));
            kept.extend(part().max_by(|&a, &b| column[a].total_cmp(&column[b])));
        }
    }
    columns.iter().map(|c| kept.iter().map(|&i| c[i]).collect()).collect()
}

/// Abscissa and ordinate of the only curve, as many points as a long record may have.
fn path(curves: &[Curve]) -> Vec<Vec<f64>> {
    let points = curves.first().map_or(&[][..], |c| &c.points);
    let every = points.len().div_ceil(2 * PLACES).max(1);
    let (x, y) = points.iter().step_by(every).copied().unzip();
    vec![x, y]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(points: &[(f64, f64)]) -> Curve {
        Curve { label: "a".into(), points: points.to_vec() }
    }

    #[test]
    fn curves_of_different_places_share_an_abscissa() {
        let curves = [curve(&[(1.0, 10.0), (3.0, 30.0)]), curve(&[(3.0, -3.0), (2.0, -2.0)])];
        let json = serde_json::to_string(&Plot::new("t", "x", "y", &curves, false)).unwrap();
        assert!(json.contains(r#""data":[[1,2,3],[10,null,30],[null,-2,-3]]"#), "{json}");
        assert!(json.contains(r#""kind":"lines""#), "{json}");
    }

    #[test]
    fn what_turns_back_is_a_path() {
        let loops = [curve(&[(0.0, 1.0), (1.0, 0.0), (0.0, -1.0)])];
        let json = serde_json::to_string(&Plot::new("t", "x", "y", &loops, false)).unwrap();
        assert!(json.contains(r#""kind":"path""#) && json.contains("[[0,1,0],[1,0,-1]]"), "{json}");
    }

    #[test]
    fn dots_keep_places_of_their_own_and_the_colour_of_their_name() {
        let unnamed = Curve { label: String::new(), points: vec![(3.0, 4.0)] };
        let curves = [curve(&[(2.0, 1.0), (1.0, 1.0)]), unnamed];
        let json = serde_json::to_string(&Plot::dots("t", "x", "y", &curves)).unwrap();
        assert!(json.contains(r#""kind":"dots""#) && json.contains("[[2,1],[1,1],[3],[4]]"), "{json}");
        assert!(json.contains(r##""colours":["#0072b2","#0072b2"]"##), "{json}");
    }

    /// A single spike in a long record is still there.
    #[test]
    fn thinning_keeps_the_envelope() {
        let mut points: Vec<(f64, f64)> = (0..100_000).map(|i| (f64::from(i), (0.1 * f64::from(i)).sin())).collect();
        points[70_001].1 = 7.0;
        let columns = thinned(shared(vec![points]));
        assert!(columns[0].len() <= PLACES + 2, "{} places", columns[0].len());
        assert!(columns[1].contains(&7.0), "the spike is lost");
        assert!(columns[0].windows(2).all(|w| w[0] < w[1]), "the abscissa ascends");
    }

    #[test]
    fn numbers_are_short_and_a_page_stays_whole() {
        let values = Numbers(vec![0.1 + 0.2, 1.0, -0.0, 123_456_789.123, 1.5e-7, f64::NAN], 6);
        assert_eq!(serde_json::to_string(&values).unwrap(), "[0.3,1,0,123457000,1.5e-7,null]");
        let page = embedded("plot", &"</script><b>");
        assert_eq!(page.matches('<').count(), 2, "{page}");
    }
}
