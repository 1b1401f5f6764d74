//! A gear: data, mesh, material.

use mesh::{GroupNames, Mesh};

use super::flank::{MODIFICATION, ModificationScene, RawModification};
use super::models::{RawShaft, SHAFT, ShaftScene};
use super::motion::{BEARING, BODY, BearingScene, BodyScene, RawBearing, RawBody};
use crate::data_file::DataFile;
use crate::table::{INF, Table};

fields! { GroupNames, Material; BoreScene: is_default, ModificationScene: is_none }

table! {
    /// `[pinion]`
    GEAR, RawGear => GearScene: "gear 1; the wheel has the same keys", needed ["teeth", "helix_angle_deg"]; {
        teeth: signed_whole(5, 2000) => {u32} as signed_teeth, "number of teeth, negative of an internal gear (ISO 21771: z = -93). The wheel alone may be one; its diameters and the centre distance may then be given with the standard's sign or without, its profile shift has that of the standard, minus that of handbooks with z > 0";
        helix_angle_deg: bare(-60.0, 60.0) => {f64}, "helix angle at the reference cylinder, degrees, right hand positive; default: of the wheel the pinion's, other hand, of an internal gear the same hand. Stated for the wheel it must agree";
        face_width_mm: bare(0.01, 1e4), "the gear's own face width about its own mid-face, mm; default: `face_width_mm` of `[pair]`. Where both gears state theirs, `[pair]` needs none";
        bore_diameter_mm: bare(1e-3, INF) => {f64}, "diameter of the bore, mm, below the reference diameter; default: that of the `mesh`; without one 55 % of the reference diameter, or half the root diameter where that leaves no rim. Stated, it must be the mesh's within a thousandth. Of an internal gear its outside, which holds it, above the root diameter; default there: the root diameter and eight modules";
        profile_shift: number(-1.5, 2.0, 0.0), "profile shift coefficient x";
        tip_diameter_mm: bare(0.0, INF) => {Option<f64>}, "tip diameter, mm, 0.5 to 2 reference diameters; default: from addendum and profile shift";
        tip_edge_radius_mm: number(0.0, INF, 0.0) => {f64}, "radius of the arc that rounds the tip edges, mm, at most a quarter of the module; 0: sharp. Slices see it, the mesh does not";
        thickness_allowance_mm: number(0.0, INF, 0.0) => {f64}, "thinning of the tooth in the normal section, mm, at most half the module; this gear's own";
        pitch_errors_um: numbers() => {Vec<f64>}, "cumulative pitch (index) deviation of each tooth, um, -1000 .. 1000, tooth 0 first. Arc on the reference circle, positive where the tooth as a whole is too far counter-clockwise seen from +z, the direction in which teeth are numbered (of an internal gear clockwise)";
        pitch_errors_file: text() => [Vec<f64>], "file of them. Numbers in um, separated by commas, semicolons or blanks; # begins a comment";
        shaper: table(SHAPER: RawShaper) => {Option<ShaperScene>};
        mesh: text() => {Option<DataFile<Mesh>>}, "Gmsh mesh file of the gear, in place of the built-in mesher";
        mesher: table(MESHER: RawMesher) => {Option<MesherScene>};
        groups: always(GROUPS: RawGroups) => {GroupNames};
        bore: table(BORE: RawBore) => {BoreScene};
        material: always(MATERIAL: RawMaterial) => (Material);
        modification: table(MODIFICATION: RawModification) => {ModificationScene};
        body: table(BODY: RawBody) => {Option<BodyScene>};
        bearing: table(BEARING: RawBearing) => {BearingScene};
        shaft: table(SHAFT: RawShaft) => {Option<ShaftScene>};
    }
}

/// `[wheel]`
pub(super) static WHEEL: Table = Table { about: "gear 2", keys: GEAR.keys, needed: &["teeth"] };

table! {
    /// `[wheel.shaper]`
    SHAPER, RawShaper => ShaperScene Copy: "the shaper cutter that makes an internal gear: its root fillets, and what it takes of its tips"; {
        teeth: bare_whole(5, 2000) => {u32}, "number of teeth z_0; default: a third of the ring's, or as many more as it takes to make the ring's tips without interference";
        profile_shift: number(-1.5, 2.0, 0.0), "profile shift coefficient x_0";
        tip_rounding_coefficient: bare(1e-3, 2.0) => {f64}, "radius of its rounded tip edges over the module, a circle in the transverse section; default: `root_radius_coefficient` of `[pair]`, or the largest that the cutter has room for";
    }
}

table! {
    /// `[pinion.mesher]`
    MESHER, RawMesher => MesherScene Copy Eq; defaults: "the built-in structured mesher, used where there is no `mesh`"; {
        order: whole(1, 2, 2), "1: hex8, 2: hex20";
        elements_profile: whole(1, 500, 6), "elements along the active flank";
        elements_fillet: whole(2, 500, 6), "elements along fillet and root land";
        elements_thickness: whole(1, 500, 4), "elements across the tooth";
        elements_face: bare_whole(1, 2000) => {u32}, "elements along the face width b; default: b / (1.7 m_n), with root stress b / m_n, at least 6; twice as many with order 1. A third of that or less is remarked on";
        elements_rim: whole(1, 500, 5), "elements from the root to the bore";
        sector_teeth: whole(0, u32::MAX, 0) => {u32}, "0: whole gear; 1: periodic sector, which stands for the whole gear; k: open sector of k teeth, cut faces free, less than the gear has. One tooth of a whole gear is meshed where that is enough (reduced, no ParaView files)";
    }
}

table! {
    /// `[pinion.groups]`
    GROUPS, RawGroups: "the mesh's own names of the parts of the gear; {k} stands for the tooth number"; {
        bore: text(), "the bore; default: bore";
        flank_left: text(), "counter-clockwise side of each tooth, seen from +z, of an internal gear the clockwise side; default: flank_left_{k}";
        flank_right: text(), "the other side; default: flank_right_{k}";
        cut_0: text(), "cut face of a sector towards the tooth before: the clockwise one, of an internal gear the other one; default: cut_0";
        cut_1: text(), "cut face towards the next tooth; default: cut_1";
    }
}

table! {
    /// `[pinion.bore]`
    BORE, RawBore => BoreScene Copy; defaults: "how the shaft holds the bore; models with a mesh, without `[accuracy]`"; {
        held_mm: numbers() => {Option<[f64; 2]>}, "part of the bore that is held, from and to, mm from mid-face along +z; default: all of it. Held are faces of the mesh that lie between the two as a whole; the mesher has rows of faces every face width over `elements_face`";
        coupling: word(Coupling), "how the bore follows the shaft. kinematic: every node moves with the shaft's cross-section, a rigid bore; distributing: the bore deforms, its area-weighted mean displacement and turn are the shaft's (not of the model full); elastic: it stands on springs, all around or at `bolts`, on the shaft's cross-section";
        radial_n_per_mm3: number(0.0, 1e9, 0.0), "stiffness of an elastic bore per area, N/mm per mm^2, along the radius";
        tangential_n_per_mm3: number(0.0, 1e9, 0.0), "along the circumference, above 0 here or at `bolts`; where the bore passes no torque, as on a bearing, any small one will do";
        axial_n_per_mm3: number(0.0, 1e9, 0.0), "along the axis, likewise";
        bolts: table(BOLTS: RawBolts) => {Option<BoltsScene>};
    }
}

table! {
    /// `[pinion.bore.bolts]`
    BOLTS, RawBolts => BoltsScene Copy: "bolts, keys or teeth of a spline: springs of an elastic bore at places of the gear, beside those all around or, from three on, in their place. Each tooth is then held otherwise", needed ["count", "width_mm"]; {
        count: bare_whole(1, 1000) => {u32}, "their number, evenly around";
        first_angle_deg: number(-360.0, 360.0, 0.0), "angle of the middle of the first one, degrees, counter-clockwise seen from +z, from the middle of tooth 0 at mid-face";
        width_mm: bare(1e-3, 1e4) => {f64}, "arc of the bore that each holds, mm";
        over_mm: numbers() => {Option<[f64; 2]>}, "heights between which they hold, from and to, mm from mid-face along +z; default: all that is held";
        radial_n_per_mm: number(0.0, 1e12, 0.0), "stiffness of each along the radius, N/mm, spread evenly over what it holds";
        tangential_n_per_mm: number(0.0, 1e12, 0.0), "along the circumference, N/mm";
        axial_n_per_mm: number(0.0, 1e12, 0.0), "along the axis, N/mm";
        opens: switch(false), "whether each lifts off along its radius, where it then carries nothing, in a gearbox at rest; false: it pulls as it presses";
        preload_n: number(0.0, 1e12, 0.0), "force that presses each bolt that opens before any load, N; flanks have their shape under it";
    }
}

choices! {
    /// How a bore follows its shaft.
    pub enum Coupling {
        /// As a rigid body, node by node.
        Kinematic = "kinematic",
        /// By its area-weighted mean displacement and mean turn.
        Distributing = "distributing",
        /// On springs all around.
        Elastic = "elastic",
    }
}

table! {
    /// `[material]`; a gear's own table takes its defaults from this one.
    MATERIAL, RawMaterial => Material Copy: "linear elastic material; a gear's own table takes its defaults from `[material]`"; {
        young_mpa: number(1.0, 1e7, 2.06e5), "Young's modulus, MPa";
        poisson: number(-0.9, 0.499, 0.3), "Poisson's ratio";
        density_kg_m3: number(1.0, 1e5, 7850.0), "density, kg/m^3";
    }
}
