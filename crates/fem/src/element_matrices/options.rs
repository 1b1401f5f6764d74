//! Which variant of an element is meant.

/// Enhancement of hex8 against locking in bending.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, serde::Serialize)]
pub enum IncompatibleModes {
    /// Three quadratic modes an axis with the Jacobian of the centre and the ratio det J0 / det J, so that
    /// distorted elements pass the patch test. Source: Taylor, Beresford and Wilson, IJNME 10, 1976.
    #[default]
    Taylor,
    /// Incompatible modes without the ratio, as some other programs have them: fails the patch test slightly on
    /// distorted elements. For comparison with them.
    WithoutJacobianRatio,
    /// Plain hex8: locks in bending. For comparison.
    Off,
}

/// Points of integration for the stiffness of hex20.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, serde::Serialize)]
pub enum Integration {
    /// 3 x 3 x 3 points: no zero modes but the rigid ones.
    Full,
    /// 2 x 2 x 2 points: softer, and on coarse meshes much nearer to the limit (six elements along the profile of a
    /// tooth: transmission error 0.3 % below it, with 27 points 1 %). Each element has six zero modes more; they die
    /// out where elements lie side by side, but not along a single stack, which is then refused as movable.
    #[default]
    Reduced,
}

/// Poisson's ratio from which elements of a kind, as the program integrates them, are too stiff by volumetric locking;
/// `None` where they are not up to 0.499.
///
/// A cube of 4 x 4 x 4 cells under a quarter of its top, sides held, deflects at 0.499 less than it should by 94 %
/// (tet4), 88 % (wedge6), 20 % (hex27), 17 % (tet10), 12 % (wedge15); at 0.3 by 24, 16, 0, 7 and 4 %. Source: own
/// measurement, `ale-gear envelope --only F11`.
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
    /// For hex8.
    pub incompatible_modes: IncompatibleModes,
    /// For hex20.
    pub integration: Integration,
}
