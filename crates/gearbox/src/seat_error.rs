//! Errors of bearings between shafts, and of shafts that do not rotate.

/// Reasons for which a bearing cannot be seated in a shaft, or a shaft cannot be stationary.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SeatError {
    /// A bearing between a shaft and the same shaft.
    #[error("{bearing} is between shaft {shaft} and itself")]
    Itself {
        /// Name of the bearing.
        bearing: String,
        /// Name of the shaft.
        shaft: String,
    },
    /// A seat off the axis of a rotating shaft.
    #[error("the seat of {bearing} is {arm_mm} mm beside the axis of shaft {shaft}, which turns")]
    Turns {
        /// Name of the bearing.
        bearing: String,
        /// Name of the shaft that contains the seat.
        shaft: String,
        /// Distance from its axis, mm.
        arm_mm: f64,
    },
    /// A bearing between two shafts, one of which is held.
    #[error("{bearing} is between two shafts, and shaft {shaft} is held: bearings of held shafts are rigid")]
    Held {
        /// Name of the bearing.
        bearing: String,
        /// Name of the held shaft.
        shaft: String,
    },
    /// A stationary shaft whose rotation nothing prevents.
    #[error("shaft {shaft} stands, and none of its bearings holds its turn")]
    Free {
        /// Name of the shaft.
        shaft: String,
    },
    /// A part that must rotate, on a stationary shaft.
    #[error("{part} is on shaft {shaft}, which stands")]
    Stands {
        /// Kind of part: gear, input or torque.
        part: String,
        /// Name of the shaft.
        shaft: String,
    },
    /// A torque or the input on a shaft that is fixed in space.
    #[error("{part} is on shaft {shaft}, which is fixed in space")]
    Fixed {
        /// Kind of part: input or torque.
        part: String,
        /// Name of the shaft.
        shaft: String,
    },
    /// An input that cannot rotate while a shaft is fixed.
    #[error("with shaft {fixed} fixed in space the input on shaft {input} cannot turn")]
    Locked {
        /// Name of the input's shaft.
        input: String,
        /// Name of the fixed shaft.
        fixed: String,
    },
    /// A shaft that is both stationary and held.
    #[error("shaft {shaft} is fixed and held, so nothing of it moves")]
    Nothing {
        /// Name of the shaft.
        shaft: String,
    },
}

impl SeatError {
    /// Hint for the user: what to do next.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Itself { .. } => {
                "name another shaft with `in_shaft`, or leave it out: the seat is in the housing then"
            }
            Self::Turns { .. } => {
                "shafts within turning shafts have one axis: give both the same x and y in `origin_mm`; or let the outer one \
                 stand (`stands = true`), as a carrier seen from itself"
            }
            Self::Held { .. } => "leave `held` out and give that shaft bearings, or seat this one in the housing",
            Self::Free { .. } => {
                "give one of its bearings `turn_stiffness_nm_per_rad`: what holds the carrier where it is seen from"
            }
            Self::Stands { .. } => "leave `stands` out, or put it on a shaft that turns",
            Self::Fixed { .. } => "leave it out: the torque of a fixed shaft is what its bearings hold",
            Self::Locked { .. } => {
                "fix another shaft, or drive another one: the numbers of teeth leave this one no speed"
            }
            Self::Nothing { .. } => "leave the shaft out and seat its bearings in the housing",
        }
    }
}
