//! Positions of shafts and parts of a REXS file in the axes of a gearbox file: z along the u axis of the first shaft, y
//! along its w axis.

use super::{
    RexsError,
    document::{Model, Part},
};

/// Digits of places in a file, mm.
const DIGITS: f64 = 1e-2;
/// Sine of the angle up to which axes are parallel.
const PARALLEL: f64 = 1e-6;
/// Digits that places are written with, mm: sums of numbers of a file.
const WRITTEN: f64 = 1e9;

/// A shaft in its place.
pub(super) struct PlacedShaft<'m, 'a> {
    part: Part<'m, 'a>,
    /// Where its z = 0 lies, mm.
    pub origin: [f64; 3],
    support: [f64; 3],
    axis: [f64; 3],
    /// +1 where its own u axis is along z, -1 where it is against it.
    pub sign: f64,
    length: f64,
    version: &'a str,
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3])
}

fn unit(a: [f64; 3]) -> Option<[f64; 3]> {
    let length = dot(a, a).sqrt();
    (length > 0.0 && length.is_finite()).then(|| a.map(|x| x / length))
}

fn written(x: f64) -> f64 {
    // Adding zero turns -0 into 0.
    (WRITTEN * x).round() / WRITTEN + 0.0
}

/// Shafts in their places, in the frame of the first one; `lengths` are theirs, mm.
pub(super) fn placed<'m, 'a>(
    model: &Model<'a>,
    shafts: &[Part<'m, 'a>],
    lengths: &[f64],
) -> Result<Vec<PlacedShaft<'m, 'a>>, RexsError> {
    let axis_of = |part: &Part<'_, '_>| {
        let axis = part.vector("u_axis_vector")?.and_then(unit);
        axis.ok_or_else(|| RexsError::Missing { part: part.named(), attribute: "u_axis_vector" })
    };
    let Some(first) = shafts.first() else { return Ok(Vec::new()) };
    let z = axis_of(first)?;
    let w = first.vector("w_axis_vector")?.unwrap_or([0.0, 0.0, 1.0]);
    let beside = [w, [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]];
    let across = |w: [f64; 3]| unit(cross(w, z)).filter(|_| unit(w).is_some_and(|w| dot(w, z).abs() < 0.99));
    let x = beside.into_iter().find_map(across).unwrap_or([1.0, 0.0, 0.0]);
    let y = cross(z, x);
    let frame = first.text("reference_component_for_position");
    let one = |(part, length): (&Part<'m, 'a>, &f64)| {
        let axis = axis_of(part)?;
        let unfit = |what: &str| {
            let hint = "a gearbox file has parallel shafts in one frame: take a pair alone with `--stage N`".into();
            Err(RexsError::Unfit { part: part.named(), what: what.into(), hint })
        };
        let off = cross(axis, z);
        if dot(off, off).sqrt() > PARALLEL {
            return unfit("is not parallel to the first one (`u_axis_vector`)");
        }
        if part.text("reference_component_for_position") != frame {
            return unfit("is placed in another frame than the first one (`reference_component_for_position`)");
        }
        let missing = || RexsError::Missing { part: part.named(), attribute: "support_vector" };
        let support = part.vector("support_vector")?.ok_or_else(missing)?;
        let sign = if dot(axis, z) < 0.0 { -1.0 } else { 1.0 };
        let end = [0, 1, 2].map(|k| support[k] + if sign < 0.0 { length * axis[k] } else { 0.0 });
        let origin = [x, y, z].map(|e| written(dot(end, e)));
        Ok(PlacedShaft { part: *part, origin, support, axis, sign, length: *length, version: model.version() })
    };
    shafts.iter().zip(lengths).map(one).collect()
}

impl PlacedShaft<'_, '_> {
    /// Where the middle of a part is along the shaft, mm from its z = 0; `width` is that of a gear, whose coordinate REXS
    /// 1.0 has at its lower face.
    pub(super) fn position(
        &self,
        part: &Part<'_, '_>,
        coordinate: &'static str,
        width: Option<f64>,
    ) -> Result<f64, RexsError> {
        const FRAME: &str = "reference_component_for_position";
        let in_frame = self.part.text(FRAME) == part.text(FRAME);
        let by_place = part
            .vector("support_vector")?
            .filter(|_| in_frame)
            .map(|s| dot([0, 1, 2].map(|k| s[k] - self.support[k]), self.axis));
        let is_first = self.version == "1.0";
        let middle = |u: f64| u + width.filter(|_| is_first).map_or(0.0, |b| 0.5 * b);
        let stated = part.number(coordinate, "mm")?.map(middle);
        if let (Some(a), Some(b)) = (by_place, stated)
            && (a - b).abs() > DIGITS
            && !is_first
        {
            return Err(RexsError::Unfit {
                part: part.named(),
                what: format!("stands at {b} mm of its shaft (`{coordinate}`) and at {a} mm (`support_vector`)"),
                hint: "correct one of both in the file".into(),
            });
        }
        let own = by_place.or(stated);
        let own = own.ok_or_else(|| RexsError::Missing { part: part.named(), attribute: coordinate })?;
        Ok(written(if self.sign < 0.0 { self.length - own } else { own }))
    }
}
