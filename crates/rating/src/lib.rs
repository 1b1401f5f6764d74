//! Will it hold?
//!
//! Load capacity of a gear pair after the standards: pitting and tooth root bending (ISO 6336-1, -2, -3, -5), service life under load spectra (ISO 6336-6), scuffing (ISO/TS 6336-20, -21), micropitting (ISO/TS 6336-22), losses of the mesh. Formulas depend on numbers only: geometry and stresses come from the crates before this one. Each formula names its clause; what lies outside of a standard's range is told by [`Outside`].
//!
//! | module | question |
//! |---|---|
//! | `geometry` | which numbers of a pair do the standards need? |
//! | `material`, `lubricant` | what are gears and oil made of? |
//! | `deviation` | what do deviations leave after running-in? |
//! | `dynamic_factor`, `load_distribution` | by how much is the nominal load raised? |
//! | `life` | which stress for how many cycles? |
//! | `pitting`, `bending` | which stress may flank and root bear? |
//! | `standard` | all of them for one pair |
//! | `lubrication`, `rolling`, `flash` | how warm and how oily are sliding flanks? |
//! | `scuffing` | is the contact warmer than the oil bears? |
//! | `film` | how thick is the oil film, and how thick has it to be? |
//! | `micropitting` | is it, by the load sharing of the standard? |
//! | `tribology` | friction, heat and film of the solved contact |
//! | `local` | how safe is a point of the solved contact? |
//! | `spectrum` | what do many loads do over a life? |
//! | `local_damage` | and what at each place, by solved stresses? |
//!
//! Lengths in mm, forces in N, stresses in MPa, speeds of rotation in 1/min, line speeds in m/s, deviations in um.

mod bending;
mod deviation;
mod dynamic_factor;
mod edition;
mod error;
mod film;
mod flash;
mod geometry;
mod life;
mod load_distribution;
mod local;
mod local_damage;
mod lubricant;
mod lubrication;
mod material;
mod micropitting;
mod outside;
mod pitting;
mod rolling;
mod scuffing;
mod spectrum;
mod standard;
mod table;
mod tribology;

pub use bending::{BendingFactors, RootFactors, bending_curve, mean_stress_factor};
pub use deviation::{Deviations, RunningIn};
pub use dynamic_factor::{DynamicFactor, DynamicLoad, dynamic_factor};
pub use edition::Edition;
pub use error::RatingError;
pub use film::test_specific_film;
pub use geometry::PairGeometry;
pub use life::StressLife;
pub use load_distribution::{TransverseLoad, face_load_factor_bending, transverse_load_factors};
pub use local::{local_bending_safety, local_contact_stress, local_pitting_safety};
pub use local_damage::{FlankPlace, LocalDamage, SolvedStress};
pub use lubricant::{Lubricant, LubricantBase, Lubricants};
pub use lubrication::{Lubrication, LubricationMethod};
pub use material::{Material, MaterialGroup, Materials};
pub use micropitting::{StandardMicropitting, standard_micropitting};
pub use outside::{Outside, micropitting_scope};
pub use pitting::{FlankFactors, FlankSurface, PittingFactors, pitting_curve, pitting_factors};
pub use rolling::{Rolling, RollingPlace};
pub use scuffing::{FlashRating, IntegralRating, ScuffingInput, ScuffingRating, scuffing_rating};
pub use spectrum::{
    Cycles, GearDamage, LoadBin, RatedLoad, RatedSpectrum, Spectrum, SpectrumRating, miner_safety, miner_sum,
};
pub use standard::{GearInput, GearRating, GivenFactors, MeshStiffness, RatingInput, StandardRating, standard_rating};
pub use tribology::{
    ContactField, FilmField, LocalScuffing, MeshLoss, MicropittingRating, PressedPlace, SolvedContact, permissible_film,
};
