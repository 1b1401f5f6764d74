//! Contact of two bodies without a gear: Hertz, local approach, patch test.

mod half_section;
mod hertz;
mod local_approach;
mod patch_test;
mod plane;
mod plane_gear;
