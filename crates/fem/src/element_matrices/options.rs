//! Variants of the elements.

/// Incompatible modes of hex8 against locking in bending.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, serde::Serialize)]
pub enum IncompatibleModes {
    /// Three quadratic modes per axis with the Jacobian at the centre and the ratio det J0 / det J, so that distorted
    /// elements pass the patch test. Source: Taylor, Beresford and Wilson, IJNME 10, 1976.
    #[default]
    Taylor,
    /// Incompatible modes without the ratio, as in some other programs. Distorted elements fail the patch test
    /// slightly. For comparison with those programs.
    WithoutJacobianRatio,
    /// Plain hex8, which locks in bending. For comparison.
    Off,
}

/// Integration points for the stiffness of hex20.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, serde::Serialize)]
pub enum Integration {
    /// 3 x 3 x 3 points: the only zero modes are the rigid-body modes.
    Full,
    /// 2 x 2 x 2 points: softer, and on coarse meshes much nearer to the limit. With six elements along the profile of
    /// a tooth the transmission error is 0.3 % below the limit, with 27 points 1 %. Each element has six additional
    /// zero modes. They are suppressed where elements lie side by side, but not in a single stack of elements, which is
    /// rejected as not positive definite.
    #[default]
    Reduced,
}

/// Poisson's ratio from which elements of a kind, as integrated here, are too stiff by volumetric locking; `None` if
/// they do not lock up to 0.499.
///
/// Test: a cube of 4 x 4 x 4 cells, loaded on a quarter of its top, with its sides held. At 0.499 its deflection is too
/// small by 94 % (tet4), 88 % (wedge6), 20 % (hex27), 17 % (tet10), 12 % (wedge15); at 0.3 by 24, 16, 0, 7 and 4 %.
/// Source: own measurement, `ale-gear envelope --only F11`.
pub fn locks_from(kind: mesh::ElementKind) -> Option<f64> {
    use mesh::ElementKind as Kind;
    match kind {
        Kind::Tet4 | Kind::Wedge6 => Some(0.4),
        Kind::Tet10 | Kind::Wedge15 | Kind::Hex27 => Some(0.48),
        Kind::Hex8 | Kind::Hex20 => None,
    }
}

/// Variants of the elements.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, serde::Serialize)]
pub struct ElementOptions {
    /// Incompatible modes of hex8.
    pub incompatible_modes: IncompatibleModes,
    /// Integration points of hex20.
    pub integration: Integration,
}
