//! Headline values for which error bounds are given: `[accuracy]`.
//!
//! A new quantity is a row of `quantities!`; `analysis` takes its value from a result.

use serde::{Serialize, Serializer};

use crate::spanned::Word;

/// A headline number once: its key in `[accuracy]`, its unit, and what it is; then which of those of a pair are also
/// numbers of every mesh of a gearbox, and what they are there.
macro_rules! quantities {
    (
        pair { $($variant:ident: $key:ident, $unit:literal, $about:literal;)* }
        gearbox { $($own:ident: $own_key:ident, $own_unit:literal, $own_about:literal;)* }
        both { $($both:ident: $both_key:ident, $both_about:literal;)* }
    ) => {
        /// A headline value for which error bounds are given, and for which a scene or a gearbox may request an
        /// accuracy.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
        pub enum Quantity {
            $(#[doc = concat!($about, ", ", $unit, ".")] $variant,)*
            $(#[doc = concat!($own_about, ", ", $own_unit, ".")] $own,)*
        }

        impl Quantity {
            /// All quantities of a pair, in the order of tables.
            pub const ALL: &'static [Self] = &[$(Self::$variant),*];
            /// All quantities of a gearbox, in the order of tables.
            pub const OF_GEARBOX: &'static [Self] = &[$(Self::$both,)* $(Self::$own),*];

            /// Key of the quantity in `[accuracy]`.
            pub fn key(self) -> &'static str {
                match self {
                    $(Self::$variant => stringify!($key),)*
                    $(Self::$own => stringify!($own_key),)*
                }
            }

            /// Unit of the quantity; empty for a ratio.
            pub fn unit(self) -> &'static str {
                match self { $(Self::$variant => $unit,)* $(Self::$own => $own_unit,)* }
            }

            /// Description of the quantity.
            pub fn about(self) -> &'static str {
                match self { $(Self::$variant => $about,)* $(Self::$own => $own_about,)* }
            }
        }

        table! {
            /// `[accuracy]`
            ACCURACY, RawAccuracy: "how exact the headline numbers are to be, each as \"1 %\" of itself or as \"0.05 um\" in its unit (um, line length mm, force N, stress MPa, stiffness N/um); with it `model` is \"auto\" where none is written"; {
                $($key: text(), $about;)*
            }
        }

        table! {
            /// `[accuracy]` of a gearbox
            GEARBOX_ACCURACY, RawGearboxAccuracy: "how exact the headline numbers at rest are to be, each as \"1 %\" of itself or as \"0.5 um\" in its unit (um, force N, pressure MPa, frequency Hz; a ratio has none). With it the program refines meshes, slices, positions and shaft elements until the bounds keep what is asked; what the scene of a pair states stays, and so do its meshes from files. Not with [motion]"; {
                $($both_key: text(), $both_about;)*
                $($own_key: text(), $own_about;)*
            }
        }

        impl Asked for RawAccuracy {
            fn words(&self) -> Vec<(Quantity, &Word)> {
                vec![$((Quantity::$variant, &self.$key)),*]
            }
        }

        impl Asked for RawGearboxAccuracy {
            fn words(&self) -> Vec<(Quantity, &Word)> {
                vec![$((Quantity::$both, &self.$both_key),)* $((Quantity::$own, &self.$own_key)),*]
            }
        }
    };
}

/// A table of `[accuracy]`.
pub(crate) trait Asked {
    /// All its quantities with their words, in the order of tables.
    fn words(&self) -> Vec<(Quantity, &Word)>;

    /// Quantities that an accuracy is asked of, with the words that say which.
    fn asked(&self) -> impl Iterator<Item = (Quantity, &toml::Spanned<String>)> {
        self.words().into_iter().filter_map(|(quantity, word)| Some((quantity, word.as_ref()?)))
    }
}

quantities! {
    pair {
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
    gearbox {
        MisalignmentInPlane: misalignment_in_plane, "um", "mean misalignment f of every mesh in the plane of action by shafts, bearings and housing, over the face width";
        FaceLoadFactor: face_load_factor, "", "face load factor K_Hbeta of every mesh, of the solved load distribution";
        BearingForce: bearing_force, "N", "size of the mean force on every bearing";
        NaturalFrequency: natural_frequency, "Hz", "lowest natural frequency above zero, with `[vibration]`";
    }
    both {
        MeanSte: mean_ste, "mean static transmission error of every mesh";
        PeakToPeakSte: peak_to_peak_ste, "peak to peak of the static transmission error of every mesh";
        MaxPressure: max_pressure, "largest contact pressure of every mesh";
    }
}

impl Quantity {
    /// Quantities of a pair in motion.
    pub const OF_MOTION: [Self; 2] = [Self::RmsDte, Self::PeakToPeakDte];

    /// Whether it belongs to a pair in motion and not to a static pair.
    pub fn is_of_motion(self) -> bool {
        Self::OF_MOTION.contains(&self)
    }
}

impl Serialize for Quantity {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.key())
    }
}
