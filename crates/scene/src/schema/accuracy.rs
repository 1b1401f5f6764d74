//! Headline numbers that bounds are given for: `[accuracy]`.
//!
//! A new quantity is a row of `quantities!`; its value is taken from a result in `analysis`.

use serde::{Serialize, Serializer};

use crate::spanned::Word;

/// A headline number once: its key in `[accuracy]`, its unit, and what it is.
macro_rules! quantities {
    ($($variant:ident: $key:ident, $unit:literal, $about:literal;)*) => {
        /// A headline number that bounds are given for and that a scene may ask an accuracy of.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
        pub enum Quantity {
            $(#[doc = concat!($about, ", ", $unit, ".")] $variant,)*
        }

        impl Quantity {
            /// All of them, in the order of tables.
            pub const ALL: &'static [Self] = &[$(Self::$variant),*];

            /// Its key in `[accuracy]`.
            pub fn key(self) -> &'static str {
                match self { $(Self::$variant => stringify!($key),)* }
            }

            /// Its unit.
            pub fn unit(self) -> &'static str {
                match self { $(Self::$variant => $unit,)* }
            }

            /// What it is.
            pub fn about(self) -> &'static str {
                match self { $(Self::$variant => $about,)* }
            }
        }

        table! {
            /// `[accuracy]`
            ACCURACY, RawAccuracy: "how exact the headline numbers are to be, each as \"1 %\" of itself or as \"0.05 um\" in its unit (um, line length mm, force N, stress MPa, stiffness N/um); with it `model` is \"auto\" where none is written"; {
                $($key: text(), $about;)*
            }
        }

        impl RawAccuracy {
            /// Quantities that an accuracy is asked of, with the words that say which, in the order of tables.
            pub(crate) fn asked(&self) -> impl Iterator<Item = (Quantity, &toml::Spanned<String>)> {
                let all: [(Quantity, &Word); Quantity::ALL.len()] = [$((Quantity::$variant, &self.$key)),*];
                all.into_iter().filter_map(|(quantity, word)| Some((quantity, word.as_ref()?)))
            }
        }
    };
}

quantities! {
    MeanSte: mean_ste, "um", "mean static transmission error";
    PeakToPeakSte: peak_to_peak_ste, "um", "peak to peak of the static transmission error";
    FirstSteHarmonic: first_ste_harmonic, "um", "first mesh harmonic of the static transmission error";
    SecondSteHarmonic: second_ste_harmonic, "um", "second mesh harmonic of the static transmission error";
    ThirdSteHarmonic: third_ste_harmonic, "um", "third mesh harmonic of the static transmission error";
    MaxPairForce: max_pair_force, "N", "largest normal force of a tooth pair";
    MaxPressure: max_pressure, "MPa", "largest contact pressure";
    PinionRootStress: pinion_root_stress, "MPa", "largest root stress of the pinion (tension)";
    WheelRootStress: wheel_root_stress, "MPa", "largest root stress of the wheel (tension)";
    ContactLineLength: contact_line_length, "mm", "mean total contact-line length";
    MeshStiffness: mesh_stiffness, "N/um", "mean mesh stiffness (secant)";
    MeshStiffnessTangent: mesh_stiffness_tangent, "N/um", "mean mesh stiffness (tangent)";
    RmsDte: rms_dte, "um", "root mean square of the dynamic transmission error about its mean, in motion";
    PeakToPeakDte: peak_to_peak_dte, "um", "peak to peak of the dynamic transmission error, in motion";
}

impl Quantity {
    /// Those of a pair in motion.
    pub const OF_MOTION: [Self; 2] = [Self::RmsDte, Self::PeakToPeakDte];

    /// Whether it is a number of a pair in motion, not of one at rest.
    pub fn is_of_motion(self) -> bool {
        Self::OF_MOTION.contains(&self)
    }
}

impl Serialize for Quantity {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.key())
    }
}
