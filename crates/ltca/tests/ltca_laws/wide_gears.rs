//! Wide gears that are condensed by a part of their layers, against the same gears condensed as a whole; windows that are
//! foreseen from the load.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use contact::ContactError;
use fem::{ElementOptions, Material};
use geometry::GearData;
use ltca::{ForeseenWindow, StaticError, StaticModel, StaticOptions, StaticPosition};
use mesh::{Extent, StructuredOptions};
use reduction::{ElasticGear, GearReducer, LayerStack, ReductionError, ReductionOptions, ReductionWatch};
use testing::{Case, default_data, quadratic};

/// Face width, mm, and layers of it: 40 times the normal module.
const WIDTH: f64 = 120.0;
const LAYERS: u32 = 24;

/// The default pair at its line load with so many of the layers, on a coarse section.
fn of_layers(layers: u32) -> Case {
    on_section(layers, [2, 2, 2, 2])
}

/// Elements along the profile, the fillet, across the tooth, in the rim.
fn on_section(layers: u32, [profile, fillet, thickness, rim]: [u32; 4]) -> Case {
    let width = WIDTH * f64::from(layers) / f64::from(LAYERS);
    let data = default_data(20.0).map(|d| GearData { face_width: width, ..d });
    quadratic(data, None, 7500.0 * WIDTH, [profile, fillet, thickness, layers, rim], Extent::Periodic)
}

fn reducer(
    short: Case,
    condensed: u32,
    gear: usize,
    first: u32,
    options: &StaticOptions,
    window: usize,
) -> GearReducer {
    let stack = LayerStack { layers: LAYERS as usize, condensed: condensed as usize, free_count: 0 };
    let sides = options.contact.sides();
    let options = ReductionOptions { sides, window, first, elements: ElementOptions::default() };
    let watch = ReductionWatch { tell: &|_| (), wanted: &|| true };
    GearReducer::of_layers(short.meshes[gear].clone(), Material::STEEL, options, stack, watch).unwrap()
}

/// The wide pair, each gear known by so many of its layers.
fn by_layers(whole: &Case, section: [u32; 4], condensed: [u32; 2]) -> Result<StaticModel, StaticError> {
    let options = options(whole);
    let first = StaticModel::first_teeth(&whole.pair, &options).unwrap();
    let window = options.window_teeth(&whole.pair);
    let short = |i: usize| reducer(on_section(condensed[i], section), condensed[i], i, first[i], &options, window);
    let gears = [0, 1].map(|i| ElasticGear::Reduced(short(i)));
    StaticModel::new(whole.pair.clone(), gears, options)
}

/// One tooth more than the contact ratio asks for, which the load does.
fn options(case: &Case) -> StaticOptions {
    let plain = case.slice_options().with_contact(|c| c.slices = 96);
    StaticOptions { window: Some(plain.window_teeth(&case.pair) + 1), ..plain }
}

fn positions(mut model: StaticModel) -> Vec<StaticPosition> {
    model.run(4, 1, |_, _, _| ()).unwrap().positions
}

/// A pair known by four fifths of its layers stands as the pair that is known as a whole, within the error that it states:
/// transmission error, force of each pair of teeth, largest pressure.
#[test]
fn layers_tell_of_the_whole_gear() {
    compare([2; 4]);
}

/// The same on the section of the built-in mesher's defaults.
#[test]
#[ignore = "some minutes and 4 GB"]
fn layers_tell_of_the_whole_gear_on_its_default_mesh() {
    let d = StructuredOptions::default();
    compare([d.elements_profile, d.elements_fillet, d.elements_thickness, d.elements_rim]);
}

fn compare(section: [u32; 4]) {
    let whole = on_section(LAYERS, section);
    let exact = positions(whole.reduced(options(&whole)));
    let found = positions(by_layers(&whole, section, [19, 19]).unwrap());
    for (a, b) in exact.iter().zip(&found) {
        let error = b.certificate.bulk_compliance_error;
        let off = |x: f64, y: f64| (y / x - 1.0).abs();
        let forces = a.pairs.iter().zip(&b.pairs).map(|(a, b)| (a.normal_force - b.normal_force).abs());
        let (ste, pressure) = (off(a.transmission_error, b.transmission_error), off(a.max_pressure, b.max_pressure));
        let force = forces.fold(0.0, f64::max) / a.pairs.iter().map(|p| p.normal_force).sum::<f64>();
        println!(
            "phase {:.2}: {ste:.1e}, pressure {pressure:.1e}, force {force:.1e}, stated {error:.1e}",
            a.mesh_phase
        );
        assert!(error > 0.0 && error <= 5e-3, "stated {error:e}");
        assert!(ste < error && pressure < error && force < error, "{ste:e} {pressure:e} {force:e}, stated {error:e}");
    }
}

/// Layers that are too few to tell of the others are refused: an error, not a number.
#[test]
fn too_few_layers_are_refused() {
    let refused = by_layers(&of_layers(LAYERS), [2; 4], [16, 4]).unwrap_err();
    let StaticError::SetUp(ContactError::Layers { error, most }) = &refused else { panic!("{refused}") };
    println!("{refused}");
    assert!(error > most && refused.hint().is_some(), "{error:e} of {most:e}");
}

/// What a part of the layers cannot tell is refused: fields, modes, stress.
#[test]
fn layers_have_no_fields() {
    let case = of_layers(LAYERS);
    let gear = reducer(of_layers(4), 4, 0, 0, &options(&case), 2);
    let window = gear.window(3).unwrap();
    let none = |error: ReductionError| {
        assert!(matches!(error, ReductionError::Layers { layers: 24, condensed: 4 }), "{error}");
        assert!(error.hint().is_some());
    };
    none(gear.expand(&window, &vec![0.0; window.reduced.coordinates()]).unwrap_err());
    none(gear.lowest_elastic_hz().unwrap_err());
    none(gear.stress_modes(&window, &[0]).unwrap_err());
    assert!(gear.record().is_none() && window.reduced.stiffness().is_none());
}

/// A window is foreseen as wide as the run asks for: what touches beside a narrower one is in it.
#[test]
fn a_foreseen_window_does_not_starve() {
    let data = default_data(20.0).map(|d| GearData { face_width: 40.0, ..d });
    let case = quadratic(data, None, 300e3, [2, 2, 2, 8, 2], Extent::Periodic);
    let plain = case.slice_options();
    let least = plain.window_teeth(&case.pair);
    let starved = case.reduced(plain.clone()).run(4, 1, |_, _, _| ()).unwrap_err();
    assert!(starved.is_starved(), "{starved}");
    let foreseen = ForeseenWindow::new(&case.pair, &plain, 6e-3).unwrap();
    assert_eq!(foreseen.teeth, least + 1);
    let wide = StaticOptions { window: Some(foreseen.teeth), ..plain.clone() };
    assert_eq!(case.reduced(wide).run(4, 1, |_, _, _| ()).unwrap().positions.len(), 4);
    // Under a light load the contact ratio is enough.
    assert_eq!(ForeseenWindow::new(&case.pair, &plain, 0.0), None);
}
