//! Planetary stages of REXS files: which member stands, what is held, copies of planets, speeds and torques, and what is refused.

use std::{fmt::Write, path::Path};

use scene::{RexsError, gearbox::Gearbox, read_gearbox};

/// Teeth of sun, planet and ring at module 3 mm; arm of the carrier, mm.
const TEETH: [u32; 3] = [20, 22, 64];
const ARM: f64 = 63.0;
/// Torque on the sun, N m, and its speed, 1/min.
const TORQUE: f64 = 300.0;
const SPEED: f64 = 1200.0;

/// Parts and relations of a file.
#[derive(Default)]
struct Model {
    relations: String,
    components: String,
    count: u32,
}

impl Model {
    fn relation(&mut self, kind: &str, roles: &[(&str, u32, &str)]) {
        self.count += 1;
        let _ = write!(self.relations, "<relation id=\"{}\" type=\"{kind}\">", self.count);
        for (role, id, hint) in roles {
            let _ = write!(self.relations, "<ref id=\"{id}\" role=\"{role}\" hint=\"{hint}\"/>");
        }
        self.relations.push_str("</relation>\n");
    }

    /// A component at (u, v, w) with numbers as attributes.
    fn component(&mut self, id: u32, kind: &str, place: Option<[f64; 3]>, numbers: &[(&str, &str, f64)]) {
        let _ = write!(self.components, "<component id=\"{id}\" type=\"{kind}\" name=\"{kind} {id}\">");
        if let Some([u, v, w]) = place {
            for (key, [a, b, c]) in
                [("support_vector", [u, v, w]), ("u_axis_vector", [1.0, 0.0, 0.0]), ("w_axis_vector", [0.0, 0.0, 1.0])]
            {
                let _ = write!(
                    self.components,
                    "<attribute id=\"{key}\" unit=\"mm\"><array><c>{a}</c><c>{b}</c><c>{c}</c></array></attribute>"
                );
            }
        }
        for (key, unit, value) in numbers {
            let _ = write!(self.components, "<attribute id=\"{key}\" unit=\"{unit}\">{value}</attribute>");
        }
        self.components.push_str("</component>\n");
    }

    fn shaft(&mut self, id: u32, place: [f64; 3], length: f64, [outer, inner]: [f64; 2]) {
        self.component(id, "shaft", Some(place), &[]);
        self.component(
            id + 1000,
            "shaft_section",
            None,
            &[("length", "mm", length), ("outer_diameter_begin", "mm", outer), ("inner_diameter_begin", "mm", inner)],
        );
        self.relation("assembly", &[("assembly", id, "shaft"), ("part", id + 1000, "shaft_section")]);
    }

    fn gear(&mut self, [id, shaft]: [u32; 2], kind: &str, teeth: u32, place: [f64; 3]) {
        let numbers = [
            ("number_of_teeth", "none", f64::from(teeth)),
            ("normal_module", "mm", 3.0),
            ("face_width", "mm", 20.0),
            ("helix_angle_reference_diameter", "deg", 0.0),
        ];
        self.component(id, kind, Some(place), &numbers);
        self.relation("assembly", &[("assembly", shaft, "shaft"), ("part", id, kind)]);
    }

    fn side(&mut self, id: u32, kind: &str, place: [f64; 3], [inner, outer]: [(u32, &str); 2]) {
        let numbers = [
            ("radial_stiffness", "N / m", 1e20),
            ("axial_stiffness", "N / m", 4e8),
            ("bending_stiffness", "N mm / rad", 2e9),
            ("rotational_stiffness", "N mm / rad", 1e12),
        ];
        self.component(id, kind, Some(place), &numbers[..if kind == "coupling" { 4 } else { 2 }]);
        self.relation(
            "side",
            &[("assembly", id, kind), ("inner_part", inner.0, inner.1), ("outer_part", outer.0, outer.1)],
        );
    }

    fn text(&self) -> String {
        let Self { relations, components, .. } = self;
        format!(
            "<model version=\"1.4\" applicationId=\"own\"><relations>{relations}</relations><components>{components}</components></model>"
        )
    }
}

/// Sun 10, ring 11, carrier 12 with plate 13, planets from 20 and pins from 40 on; `held`: members that the casing holds.
fn stage(count: u32, held: &[u32]) -> Model {
    let mut m = Model::default();
    m.component(1, "gear_unit", None, &[]);
    m.component(2, "gear_casing", None, &[]);
    m.component(3, "planetary_stage", None, &[]);
    m.component(4, "planet_carrier", None, &[]);
    m.shaft(10, [0.0, 0.0, 0.0], 60.0, [30.0, 0.0]);
    m.shaft(11, [0.0, 0.0, 0.0], 60.0, [240.0, 220.0]);
    m.shaft(12, [80.0, 0.0, 0.0], 60.0, [60.0, 30.0]);
    m.component(
        13,
        "side_plate",
        Some([70.0, 0.0, 0.0]),
        &[("length", "mm", 12.0), ("outer_diameter", "mm", 160.0), ("inner_diameter", "mm", 60.0)],
    );
    m.relation("assembly", &[("assembly", 4, "planet_carrier"), ("part", 13, "side_plate")]);
    for (kind, shaft) in [("central_shaft", 10), ("central_shaft", 11), ("planet_carrier_shaft", 12)] {
        m.relation(kind, &[("planetary_stage", 3, "planetary_stage"), ("shaft", shaft, "shaft")]);
    }
    m.gear([60, 10], "cylindrical_gear", TEETH[0], [40.0, 0.0, 0.0]);
    m.gear([61, 11], "ring_gear", TEETH[2], [40.0, 0.0, 0.0]);
    for n in 0..count {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(n) / f64::from(count)).sin_cos();
        let at = |u: f64| [u, ARM * sin, ARM * cos];
        let (planet, pin, gear) = (20 + n, 40 + n, 62 + n);
        m.shaft(planet, at(28.0), 24.0, [50.0, 40.0]);
        m.shaft(pin, at(20.0), 62.0, [30.0, 0.0]);
        m.relation("planet_shaft", &[("planetary_stage", 3, "planetary_stage"), ("shaft", planet, "shaft")]);
        m.relation("planet_pin", &[("planetary_stage", 3, "planetary_stage"), ("shaft", pin, "shaft")]);
        m.gear([gear, planet], "cylindrical_gear", TEETH[1], at(40.0));
        for (stage, gears) in [(300 + n, [60, gear]), (400 + n, [gear, 61])] {
            m.component(stage, "cylindrical_stage", None, &[("center_distance", "mm", ARM)]);
            let [a, b] = gears;
            m.relation("stage", &[("stage", stage, "cylindrical_stage"), ("gear_1", a, ""), ("gear_2", b, "")]);
        }
        m.side(500 + n, "concept_bearing", at(40.0), [(pin, "shaft"), (planet, "shaft")]);
        m.side(600 + n, "coupling", at(76.0), [(pin, "shaft"), (13, "side_plate")]);
    }
    m.side(700, "coupling", [81.0, 0.0, 0.0], [(12, "shaft"), (13, "side_plate")]);
    for (id, shaft, u) in [(701, 10, 10.0), (702, 11, 10.0), (703, 12, 120.0)] {
        m.side(id, "concept_bearing", [u, 0.0, 0.0], [(shaft, "shaft"), (2, "gear_casing")]);
    }
    for (i, shaft) in held.iter().enumerate() {
        let u = if *shaft == 12 { 130.0 } else { 20.0 };
        m.side(710 + i as u32, "coupling", [u, 0.0, 0.0], [(*shaft, "shaft"), (2, "gear_casing")]);
    }
    for (id, shaft) in [(800, 10), (801, if held.contains(&12) { 11 } else { 12 })] {
        let own = [("torque_around_u_axis", "N m", TORQUE)];
        m.component(id, "external_load", None, if id == 800 { &own } else { &[] });
        m.relation("assembly", &[("assembly", shaft, "shaft"), ("part", id, "external_load")]);
    }
    let places = "<attribute id=\"transmits_torque\" unit=\"none\">true</attribute><attribute id=\"u_coordinate_on_shaft\" unit=\"mm\">50</attribute></component>";
    for id in [800, 801] {
        let from = m.components.find(&format!("<component id=\"{id}\"")).unwrap();
        let end = from + m.components[from..].find("</component>").unwrap();
        m.components.replace_range(end..end + "</component>".len(), places);
    }
    let speed = format!("name=\"shaft 10\"><attribute id=\"rotational_speed\" unit=\"1 / min\">{SPEED}</attribute>");
    m.components = m.components.replace("name=\"shaft 10\">", &speed);
    m
}

fn read(model: &Model) -> Result<(Gearbox, String, Vec<String>), RexsError> {
    let read = read_gearbox(&model.text(), "stage", 1)?.expect("there are shafts");
    let file = read.check(Path::new("stage.toml")).unwrap_or_else(|e| panic!("{e}\n{}", read.text));
    Ok((file, read.text, read.remarks))
}

/// Whichever member the casing holds: the carrier and all that couplings join to it stand, one planet is written with its pin,
/// and N - 1 copies at their angles; torques and speeds follow from the teeth; nothing of a copy is told as left.
#[test]
fn stages_are_read_with_what_the_casing_holds() {
    let u = f64::from(TEETH[2]) / f64::from(TEETH[0]);
    for (count, held) in [(3, 11), (4, 11), (3, 12)] {
        let (file, text, remarks) = read(&stage(count, &[held])).unwrap_or_else(|e| panic!("{e}"));
        let n = count as usize;
        // Sun, ring, N planets and pins, carrier, plate.
        assert_eq!(file.shafts.len(), 4 + 2 * n, "{text}");
        let named = |name: &str| file.shafts.iter().find(|s| s.name == name).unwrap();
        let [sun, ring, carrier, plate] = ["shaft 10", "shaft 11", "shaft 12", "side_plate 13"].map(named);
        assert!(carrier.stands && plate.stands && !sun.stands && !ring.stands);
        assert!(ring.fixed == (held == 11) && !sun.fixed, "{text}");
        assert_eq!(file.shafts.iter().filter(|s| s.stands).count(), 2 + n);
        assert_eq!((file.gears.len(), file.meshes.len()), (2 + n, 2 * n));
        let planets: Vec<_> = file.shafts.iter().filter(|s| s.name.starts_with("shaft 20")).collect();
        for planet in &planets {
            let [x, y, _] = planet.origin;
            assert!((x.hypot(y) - ARM).abs() < 1e-6, "{:?}", planet.origin);
        }
        let steps = planets.len();
        assert_eq!(steps, n);
        // A bearing of a planet is seated in its pin, a pin in the plate, and both say how rigid.
        let on_pin = file.bearings.iter().find(|b| b.name.starts_with("concept_bearing 500")).unwrap();
        assert!(file.shafts[on_pin.in_shaft.unwrap()].name.starts_with("shaft 40"));
        assert_eq!((on_pin.position, on_pin.stiffness[0][0], on_pin.stiffness[2][2]), (12.0, 1e8, 4e5));
        let in_plate = file.bearings.iter().find(|b| b.name.starts_with("coupling 600")).unwrap();
        assert_eq!(file.shafts[in_plate.in_shaft.unwrap()].name, "side_plate 13");
        assert_eq!((in_plate.position, in_plate.stiffness[5][5]), (56.0, 1e12));
        let (member, torque) = if held == 11 { ("shaft 12", TORQUE * (1.0 + u)) } else { ("shaft 11", TORQUE * u) };
        let load = &file.torques[0];
        assert_eq!(file.shafts[load.shaft].name, member);
        assert!((load.torque / 1e3 / torque - 1.0).abs() < 1e-9, "{} beside {torque}", load.torque);
        for (mesh, teeth) in [(0, TEETH[1]), (n, TEETH[2])] {
            let wanted = TORQUE * f64::from(teeth) / f64::from(TEETH[0]) / f64::from(count);
            let found = file.meshes[mesh].scene.operation.torque_nm;
            assert!((found / wanted - 1.0).abs() < 1e-9, "{found} beside {wanted}");
        }
        assert!(!remarks.iter().any(|r| r.contains("21") || r.contains("coupling")), "{remarks:?}");
    }
}

/// What a gearbox file cannot say is refused with the part.
#[test]
fn stages_that_cannot_be_are_told() {
    let said = |model: &Model| {
        let error = read(model).map(|_| ()).expect_err("it is taken");
        assert!(error.hint().is_some_and(|hint| !hint.is_empty()), "{error}");
        error.to_string()
    };
    assert!(said(&stage(3, &[])).contains("planetary stage 3 has no member that a coupling holds"));
    assert!(said(&stage(3, &[11, 12])).contains("several members that the casing holds"));
    assert!(said(&stage(1, &[11])).contains("has no two planets"));
    let mut two = stage(3, &[11]);
    two.component(5, "planetary_stage", None, &[]);
    assert!(said(&two).contains("is one of several"));
    let mut beside = stage(3, &[11]);
    beside.shaft(14, [0.0, 0.0, 60.0], 60.0, [30.0, 0.0]);
    beside.gear([90, 14], "cylindrical_gear", 20, [10.0, 0.0, 60.0]);
    beside.component(490, "cylindrical_stage", None, &[("center_distance", "mm", 60.0)]);
    beside.relation("stage", &[("stage", 490, "cylindrical_stage"), ("gear_1", 60, ""), ("gear_2", 90, "")]);
    assert!(said(&beside).contains("stage 490 is beside a planetary stage"), "{}", said(&beside));
    let whole = stage(3, &[11]).text();
    for at in (0..whole.len() - 8).step_by(97) {
        assert!(read_gearbox(&whole[..at], "stage", 1).is_err(), "cut at {at}");
    }
}
