//! Results in the programs of others: reports in a browser, files in their readers, a point of the chart by CalculiX. A
//! test whose program is not installed is shown as ignored, and named again at the end of all tests.

mod browser;
mod calculix;
mod devtools;
mod page;
mod readers;
mod schema;
#[path = "../util/mod.rs"]
mod util;
mod vtu;

use std::process::{Command, ExitCode};

use testing::Suite;

fn main() -> ExitCode {
    let browser = testing::browser();
    let ccx = testing::program("ccx", "-v");
    let [parquet, meshes, fields, schema, universal] =
        ["pyarrow.parquet", "meshio, gmsh", "meshio, pyvista", "jsonschema, tomllib", "pyuff"].map(testing::python);
    let suite = Suite::new(file!());
    // `packaging/browser.sh` names the page that it has made.
    let suite = match std::env::var_os("ALE_GEAR_PAGE") {
        Some(file) => {
            suite.needing(&browser, "a_page_solves_by_itself", move |browser| page::by_itself(browser, file.as_ref()))
        }
        None => suite,
    };
    suite
        .always("a_machine_without_programs_has_its_tests_left_out_by_name", left_out_by_name)
        .needing(&browser, "a_static_report_shows_charts_pattern_and_gears_with_fields", browser::static_report)
        .needing(&browser, "a_motion_is_shown_with_its_quasi_static_fields", browser::motion)
        .needing(&browser, "a_run_up_has_its_waterfall", browser::run_up)
        .needing(&browser, "gears_without_meshes_turn_too", browser::without_meshes)
        .needing(&browser, "a_sweep_has_its_bifurcation_diagram", browser::sweep)
        .needing(&browser, "a_gearbox_is_shown_with_its_shafts_bent", browser::gearbox)
        .needing(&browser, "studies_and_comparisons_draw_all_cases", browser::studies)
        .always("ctrl_c_ends_a_served_page_cleanly", page::ends_cleanly)
        .needing(&browser, "a_moved_slider_moves_the_curve", page::a_moved_slider)
        .needing(&browser, "two_hundred_moves_are_each_drawn", page::two_hundred_moves)
        .needing(&ccx, "calculix_has_its_point_on_the_chart", calculix::point_on_the_chart)
        .needing(&parquet, "pyarrow_reads_the_bits_of_the_history", readers::pyarrow)
        .needing(&meshes, "gmsh_and_meshio_open_a_generated_mesh", readers::gmsh_and_meshio)
        .needing(&fields, "meshio_and_pyvista_read_what_was_computed", vtu::meshio_and_pyvista)
        .needing(&universal, "pyuff_reads_the_forces_of_the_bearings", readers::pyuff)
        .needing(&schema, "an_independent_validator_agrees_with_the_schema", schema::validator)
        .run()
}

/// This very program where nothing is installed: every test is ignored with its reason and counted in the result line,
/// and the summary of all tests names each.
fn left_out_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let run = Command::new(std::env::current_exe().unwrap())
        .args(["--skip", "left_out_by_name", "--skip", "ctrl_c"])
        .env("PATH", folder.path())
        .env_remove("CHROME")
        .env(testing::FOLDER, folder.path())
        .output()
        .unwrap();
    let said = String::from_utf8(run.stdout).unwrap();
    assert!(run.status.success(), "{said}");
    let ignored: Vec<&str> = said.lines().filter(|l| l.contains(" ... ignored (no ")).collect();
    assert_eq!(ignored.len(), 15, "{said}");
    assert!(said.contains("test result: ok. 0 passed; 0 failed; 15 ignored; "), "{said}");
    let summary = testing::summary(folder.path());
    for line in ignored {
        let name = line.trim_start_matches("test ").split(' ').next().unwrap();
        assert!(summary.contains(name), "{name} is not in\n{summary}");
    }
    assert!(summary.lines().last().unwrap().contains(": 15 of 15 LEFT OUT (no "), "{summary}");
}
