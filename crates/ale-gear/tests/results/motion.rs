//! Scenes in time, as a user runs them: files, certificate, checkpoints, threads, coast flanks.

use crate::util::{Scratch, column, motion_scene as scene};

fn run(scratch: &Scratch, out: &str, more: &[&str]) -> serde_json::Value {
    let mut words = vec!["run", "a.toml", "--out", out];
    words.extend(more);
    let run = scratch.command(&words);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
    serde_json::from_str(&scratch.read(&format!("{out}/summary.json"))).unwrap()
}

/// The defaults settle into a periodic motion whose certificate holds; rows, spectrum and ledger belong together.
#[test]
fn a_motion_settles_and_its_certificate_holds() {
    // Three cycles: with both gears free this coarse pair comes back after so many, and the record must be whole
    // periods.
    let scratch = Scratch::new().file("a.toml", scene(3, ""));
    let summary = run(&scratch, "o", &[]);
    let mut names: Vec<_> =
        std::fs::read_dir(scratch.path().join("o")).unwrap().map(|e| e.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(
        names,
        [
            "contact_pattern.svg",
            "contact_pattern_pinion.csv",
            "contact_pattern_wheel.csv",
            "energy.csv",
            "history.csv",
            "report.html",
            "report.json.gz",
            "spectrum.csv",
            "summary.json"
        ]
    );
    let (headline, certificate) = (&summary["headline"], &summary["headline"]["certificate"]);
    let number = |of: &serde_json::Value, key: &str| of[key].as_f64().unwrap_or_else(|| panic!("no {key}: {of}"));
    assert!(number(certificate, "periodicity") <= 1e-6, "{certificate}");
    assert!(number(certificate, "ledger_residual_over_work").abs() < 1e-6, "{certificate}");
    assert!(number(certificate, "ledger_residual_over_turnover").abs() < 1e-6, "{certificate}");
    assert!(number(certificate, "least_contact_force_n") >= 0.0, "a flank pulls: {certificate}");
    let jump = number(certificate, "force_jump_at_tooth_change_n") / number(headline, "mean_normal_force_n");
    assert!(jump < 1e-9, "the force jumps by {jump:e} of itself at a tooth change");
    assert!(number(headline, "tooth_changes") >= 3.0);
    // Mean force balances the load: the driven gear neither speeds up nor slows down.
    let history = scratch.read("o/history.csv");
    let torque = column(&history, "wheel_moment_z_nmm");
    let mean = torque.iter().sum::<f64>() / torque.len() as f64;
    // Sixteen rows a cycle at the ends of steps: their mean is not quite that over time.
    assert!((mean.abs() - 150e3).abs() < 5e-4 * 150e3, "{mean} N mm");
    assert_eq!(torque.len(), 48);
    // Whole cycles of a periodic motion: the spectrum's lines at mesh orders are the harmonics of the headline.
    let spectrum = scratch.read("o/spectrum.csv");
    let (orders, lines) = (column(&spectrum, "mesh_order"), column(&spectrum, "dte_um"));
    for (h, amplitude) in headline["dte_harmonics_um"].as_array().unwrap().iter().take(4).enumerate() {
        let k = orders.iter().position(|o| *o == (h + 1) as f64).unwrap();
        assert!(
            (lines[k] - amplitude.as_f64().unwrap()).abs() < 1e-9,
            "order {}: {}, not {amplitude}",
            h + 1,
            lines[k]
        );
    }
    let page = scratch.read("o/report.html");
    assert!(page.contains("<svg") && !page.contains("src=") && !page.contains("href="), "the page stands alone");
    assert!(page.contains("class=\"plot\">{") && page.contains("class=\"view\">{"), "charts and gears for the script");
}

/// A run cut short goes on from its checkpoint to the bytes of the run that was not.
#[test]
fn a_run_that_was_cut_goes_on_byte_for_byte() {
    let scratch =
        Scratch::new().file("a.toml", scene(3, "checkpoint_every_cycles = 2\n[output]\nroot_stress = true\n"));
    run(&scratch, "whole", &[]);
    let settled = scratch.command(&["run", "a.toml", "--out", "cut", "--stop-after-cycles", "3"]);
    assert_eq!(settled.code, Some(0), "{}", settled.stderr);
    assert!(settled.stdout.starts_with("stopped after 3 mesh cycles"), "{}", settled.stdout);
    assert!(!scratch.path().join("cut").exists(), "a result before the end");
    let summary: serde_json::Value = serde_json::from_str(&scratch.read("whole/summary.json")).unwrap();
    let warm_up = summary["headline"]["certificate"]["warm_up_cycles"].as_u64().unwrap();
    // Once more in the midst of the rows.
    let stop = (warm_up + 1).to_string();
    let cut = scratch.command(&["run", "a.toml", "--out", "cut", "--resume", "--stop-after-cycles", &stop]);
    assert_eq!(cut.code, Some(0), "{}", cut.stderr);
    // What a killed run wrote after its checkpoint is written anew.
    let rows = scratch.path().join("cut.checkpoint/history.csv");
    let torn = std::fs::read_to_string(&rows).unwrap() + "0.1,torn";
    std::fs::write(&rows, torn).unwrap();
    run(&scratch, "cut", &["--resume", "-j", "1"]);
    for file in ["history.csv", "energy.csv", "spectrum.csv", "contact_pattern_pinion.csv", "contact_pattern_wheel.csv"]
    {
        assert!(scratch.read(&format!("whole/{file}")) == scratch.read(&format!("cut/{file}")), "{file} differs");
    }
    assert!(!scratch.path().join("cut.checkpoint").exists(), "the checkpoint is left");
}

/// At a speed that goes to nothing a motion presses and bends its teeth as the pair at rest does, row by row and place
/// by place.
#[test]
fn pattern_and_root_stress_of_a_slow_motion_are_those_at_rest() {
    let slow = "run = \"span\"\nmethod = \"generalised-alpha\"\nspectral_radius = 0.0\nmesh_damping_ratio = 0.5\n";
    // The driver is held: in a step of a second gears that are both free would be anywhere if the first one missed
    // contact.
    let motion = &format!("{slow}[output]\nroot_stress = true\n[drive]\nby = \"speed\"\n");
    let moving = scene(1, motion).replace("[operation]", "[operation]\nspeed_rpm = 0.1");
    let still = scene(1, "[output]\nroot_stress = true\n")
        .replace("kind = \"dynamic\"\npositions_per_cycle = 4", "positions_per_cycle = 16")
        .replace(crate::util::MOTION_LINES, "");
    let scratch = Scratch::new().file("a.toml", &moving).file("still.toml", &still);
    // Steps of a second resolve no vibration, and the method takes it away: of its energy nothing closes, and that is said.
    let moved = scratch.command(&["run", "a.toml", "--out", "o"]);
    assert!(moved.stderr.contains("check failed: energy_residual"), "{}", moved.stderr);
    assert_eq!(scratch.command(&["run", "still.toml", "--out", "s"]).code, Some(0));
    let (rows, positions) = (scratch.read("o/history.csv"), scratch.read("s/history.csv"));
    for gear in ["pinion", "wheel"] {
        for measure in ["max_principal", "min_principal", "von_mises"] {
            let name = format!("{gear}_root_stress_{measure}_mpa");
            let (moving, still) = (column(&rows, &name), column(&positions, &name));
            // The first row is one after the beginning of the cycle, the last one at its end, where the first position
            // is.
            for (k, found) in moving.iter().enumerate() {
                let law = still[(k + 1) % still.len()];
                assert!((found / law - 1.0).abs() < 0.01, "{name}, row {k}: {found} MPa, at rest {law}");
            }
        }
        let file = format!("contact_pattern_{gear}.csv");
        let (moving, still) = (scratch.read(&format!("o/{file}")), scratch.read(&format!("s/{file}")));
        let (p, law) = (column(&moving, "max_pressure_mpa"), column(&still, "max_pressure_mpa"));
        let most = law.iter().copied().fold(0.0, f64::max);
        assert_eq!(p.len(), law.len());
        for (k, (p, law)) in p.iter().zip(&law).enumerate() {
            assert!((p - law).abs() < 0.02 * most, "{file}, cell {k}: {p} MPa, at rest {law}, at most {most}");
        }
    }
}

/// Any number of threads, the same bytes.
#[test]
fn a_sweep_does_not_see_the_number_of_threads() {
    let sweep = "run = \"sweep\"\nperiodic_tolerance = 1e-2\nmesh_damping_ratio = 0.2\n\
                 sweep = { from_rpm = 3000, to_rpm = 4000, speeds = 2, ways = [\"up\", \"down\", \"apart\"] }\n";
    let scratch = Scratch::new().file("a.toml", scene(1, sweep).replace("per_mesh_cycle = 16", "per_mesh_cycle = 8"));
    let summary = run(&scratch, "one", &["-j", "1"]);
    run(&scratch, "two", &["-j", "2"]);
    let csv = scratch.read("one/resonance.csv");
    assert!(csv == scratch.read("two/resonance.csv"), "{csv}\n{}", scratch.read("two/resonance.csv"));
    assert_eq!(csv.lines().count(), 7);
    assert_eq!(summary["headline"]["largest"].as_array().unwrap().len(), 3);
}

/// A torque that presses the coast flanks from the beginning: the motion starts on them, beyond the backlash, and the
/// driving flanks carry nothing.
#[test]
fn a_motion_may_begin_on_the_coast_flanks() {
    let load = "[load]\ntable_s_nm = [[0.0, -150.0]]\n";
    let scratch = Scratch::new().file("a.toml", scene(1, "") + load);
    let summary = run(&scratch, "o", &[]);
    let headline = &summary["headline"];
    let number = |key: &str| headline[key].as_f64().unwrap_or_else(|| panic!("no {key}: {headline}"));
    assert_eq!(number("max_normal_force_n"), 0.0, "the driving flanks press");
    assert!(number("max_coast_normal_force_n") > 3000.0, "{headline}");
    let backlash = 1e3 * summary["geometry"]["backlash_mm"].as_f64().unwrap();
    assert!(number("max_dte_um") < -backlash, "DTE up to {} um, backlash {backlash} um", number("max_dte_um"));
}

/// What takes long says why before it is over: so slow a pair that a mesh cycle has tens of thousands of steps.
#[test]
fn a_slow_motion_says_how_many_steps_it_takes() {
    let slow = scene(1, "run = \"span\"\n").replace("resonance = 0", "resonance = 16");
    let scratch = Scratch::new().file("a.toml", slow.replace("[operation]\n", "[operation]\nspeed_rpm = 0.01\n"));
    let mut child = scratch
        .program()
        .args(["run", "a.toml", "--out", "o", "--no-cache"])
        .stderr(std::process::Stdio::piped())
        .stdout(std::process::Stdio::null())
        .spawn()
        .unwrap();
    let mut said = String::new();
    std::io::BufRead::read_line(&mut std::io::BufReader::new(child.stderr.take().unwrap()), &mut said).unwrap();
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(said.starts_with("ale-gear: a mesh cycle lasts ") && said.contains(" steps; "), "{said}");
}

/// Torque that reverses lets the driven gear cross the backlash: the coast flanks then carry it, and nothing ever
/// pulls.
#[test]
fn contact_passes_to_the_coast_flanks_when_the_torque_reverses() {
    let motion = "run = \"span\"\nmesh_damping_ratio = 0.3\n[load]\ntable_s_nm = [[0.002, 150.0], [0.004, -100.0]]\n";
    let scratch = Scratch::new().file("a.toml", scene(7, motion).replace("resonance = 0", "resonance = 12"));
    let summary = run(&scratch, "o", &[]);
    let certificate = &summary["headline"]["certificate"];
    assert!(certificate["least_contact_force_n"].as_f64().unwrap() >= 0.0, "a flank pulls: {certificate}");
    assert!(certificate["coast_contacts"].as_u64().unwrap() >= 1, "{certificate}");
    let history = scratch.read("o/history.csv");
    let last = |name: &str| *column(&history, name).last().unwrap();
    assert_eq!(last("normal_force_n"), 0.0, "the driving flanks still touch");
    let reversed = last("wheel_moment_z_nmm") / -100e3;
    let before = column(&history, "wheel_moment_z_nmm")[0] / 150e3;
    assert!((reversed - before.signum()).abs() < 0.02, "the coast flanks carry {reversed} of the reversed torque");
    // The driven gear is ahead by the backlash, and the coast flanks are pressed beyond it.
    let backlash = 1e3 * summary["geometry"]["backlash_mm"].as_f64().unwrap();
    let lag = last("dte_um");
    assert!(lag < -backlash && lag > -backlash - 15.0, "{lag} um with a backlash of {backlash} um");
}

/// A run-up writes rows with the same number in every mesh cycle, and a waterfall.
#[test]
fn a_run_up_has_a_waterfall() {
    let ramp = "run = \"ramp\"\nramp = { from_rpm = 1000, to_rpm = 3000, duration_s = 0.01, waterfall_cycles = 4 }\n[drive]\nby = \"speed\"\n";
    let scratch = Scratch::new().file("a.toml", scene(0, ramp));
    let summary = run(&scratch, "o", &[]);
    let history = scratch.read("o/history.csv");
    let speed = column(&history, "pinion_speed_rpm");
    assert_eq!(speed.len() as u64, 16 * summary["headline"]["cycles"].as_u64().unwrap());
    assert!(speed.windows(2).all(|w| w[1] > w[0] - 1e-9) && speed[speed.len() - 1] > 3000.0 - 1e-6, "{speed:?}");
    let phases = column(&history, "mesh_phase");
    for (i, phase) in phases.iter().enumerate().filter(|(i, _)| (i + 1) % 16 == 0) {
        assert!(phase.min(1.0 - phase) < 1e-9, "row {i} ends a mesh cycle at phase {phase}");
    }
    let waterfall = scratch.read("o/waterfall.csv");
    assert_eq!(waterfall.lines().next(), Some("time_s,pinion_speed_rpm,mesh_order,frequency_hz,dte_um"));
    assert_eq!(column(&waterfall, "mesh_order").iter().fold(0.0, |m: f64, o| m.max(*o)), 8.0);
}

/// A ramp ends at its last speed however short it is, and one of which a cycle would never end is refused.
#[test]
fn a_ramp_ends_at_its_last_speed() {
    let of = |from: f64, to: f64, duration: f64| {
        let drive = "[drive]\nby = \"speed\"\n";
        let ramp = format!(
            "run = \"ramp\"\nramp = {{ from_rpm = {from:?}, to_rpm = {to:?}, duration_s = {duration:?} }}\n{drive}"
        );
        Scratch::new().file("a.toml", scene(0, &ramp).replace("resonance = 0", "resonance = 10"))
    };
    for (from, to, duration) in [(0.0, 3000.0, 0.0032), (3000.0, 2000.0, 0.004), (1000.0, 1010.0, 1e-5)] {
        let scratch = of(from, to, duration);
        run(&scratch, "o", &[]);
        let speed = *column(&scratch.read("o/history.csv"), "pinion_speed_rpm").last().unwrap();
        assert!((speed - to).abs() < 1e-6, "{from} to {to} in {duration} s ends at {speed}/min");
    }
    let run = of(0.0, 0.001, 1.0).ale_gear(["run", "a.toml", "--out", "o"]);
    assert!(run.complaint().contains("a mesh cycle of the ramp lasts"), "{}", run.complaint());
    let run = of(700.0, 700.0, 1.0).ale_gear(["run", "a.toml", "--out", "o"]);
    assert!(run.complaint().contains("the speed stays"), "{}", run.complaint());
}

/// Where steps follow an error, their estimate says what their mean length makes of the peak to peak.
#[test]
fn steps_by_an_error_have_an_estimate() {
    let found = [1e-1, 1e-2].map(|tolerance| {
        let motion = format!(
            "method = \"energy\"\nerror_tolerance = {tolerance:?}\nmesh_damping_ratio = 0.3\nperiodic_tolerance = 1e-3\n"
        );
        let scratch = Scratch::new().file("a.toml", scene(0, &motion));
        let summary = run(&scratch, "o", &[]);
        let dte = summary["headline"]["peak_to_peak_dte_um"].as_f64().unwrap();
        (summary["headline"]["certificate"]["step_error_percent"].as_f64().unwrap(), dte)
    });
    let [(coarse, wide), (fine, narrow)] = found;
    let change = 100.0 * (wide / narrow - 1.0).abs();
    assert!(fine < coarse && change < 3.0 * coarse, "said {coarse} and {fine} %, found {change} %");
}

/// What does not go together is told before any work, with line and hint.
#[test]
fn wrong_motions_are_told_with_line_and_hint() {
    let says = |scene: String, text: &str| {
        let scratch = Scratch::new().file("a.toml", &scene);
        let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
        assert_eq!(run.complaint(), format!("ale-gear: a.toml:{text}\n"), "for\n{scene}");
        assert_eq!((run.code, scratch.names().len()), (Some(2), 1));
    };
    let of = |motion: &str| scene(2, motion);
    says(of("spectral_radus = 0.8\n"), "24: unknown key `spectral_radus`\nhint: did you mean `spectral_radius`?");
    says(
        of("spectral_radius = 0.8\n"),
        "24: `spectral_radius` belongs to `method = \"generalised-alpha\"`\nhint: leave it out: this method has none",
    );
    says(
        of("run = \"sweep\"\n"),
        "24: [motion.sweep] has no `from_rpm`, no `to_rpm`\nhint: from where to where has no default",
    );
    says(
        of("duration_s = 0.1\n"),
        "24: `duration_s` belongs to `run = \"span\"`\nhint: leave it out, or say so in `run`",
    );
    says(
        of("mesh_damping_ratio = 0.1\nmesh_damping_ns_per_mm2 = 1.0\n"),
        "25: `mesh_damping_ratio` and `mesh_damping_ns_per_mm2` both say how the mesh is damped\nhint: keep one of them",
    );
    says(
        of("[wheel.body]\nfree = [\"x\", \"turn\"]\n"),
        "25: `free` lists \"turn\", which is not a choice\nhint: leave it out: the driven gear's turn is always free, the \
         driver's when a torque drives it",
    );
    says(
        of("[wheel.body]\nfree = [\"x\"]\n"),
        "24: \"x\" of the wheel is free, but no bearing holds it\nhint: give `stiffness_x_n_per_mm` in [wheel.bearing]",
    );
    says(
        of("[wheel.bearing]\nstiffness_y_n_per_mm = 1e5\n"),
        "25: `stiffness_y_n_per_mm` holds a coordinate of the wheel that is not free\nhint: add \"y\" to `free` in \
         [wheel.body], or leave it out",
    );
    says(
        of("[drive]\nby = \"speed\"\ntorque_nm = 100.0\n"),
        "26: a driver whose speed is given takes whatever torque that needs\nhint: say `by = \"torque\"` in [drive], or \
         leave the torque out",
    );
    says(
        of("[load]\ntable_s_nm = [[0.1, 3.0], [0.1, 4.0]]\n"),
        "25: `table_s_nm` goes back to 0.1 s\nhint: rows of time (s, ascending) and torque (N·m): table_s_nm = [[0.0, \
         150.0], [0.1, -20.0]]",
    );
    says(
        of("").replace("kind = \"dynamic\"", "kind = \"static\""),
        "21: [motion] belongs to an analysis in time\nhint: leave it out, or say `kind = \"dynamic\"` in [analysis]",
    );
    says(
        of("checkpoint_every_cycles = 1\n[output]\nvtu = true\n"),
        "26: `vtu = true` asks for fields and stresses of an analysis in time, which this version cannot do\n\
         hint: leave it out, or use `kind = \"static\"` for them",
    );
}

/// A motion writes fields of every so many rows, at the times of these; a checkpoint would part the series.
#[test]
fn fields_come_with_the_rows() {
    let words = "run = \"span\"\n[output]\nvtu = true\nvtu_every = 8\nfields = [\"displacement\"]\n";
    let scratch = Scratch::new().file("a.toml", scene(1, words));
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
    let times = column(&scratch.read("o/history.csv"), "time_s");
    let series = scratch.read("o/gears.pvd");
    for (k, time) in times.iter().enumerate().step_by(8) {
        for gear in ["pinion", "wheel"] {
            let file = format!("{gear}_{k:05}.vtu");
            assert!(scratch.path().join("o").join(&file).is_file(), "{file} is missing");
            let entry = series.lines().find(|line| line.contains(&file)).unwrap_or_else(|| panic!("{file}: {series}"));
            let told = entry.split("timestep=\"").nth(1).and_then(|rest| rest.split('"').next()).unwrap();
            assert!((told.parse::<f64>().unwrap() - time).abs() <= 1e-9 * time.abs(), "{entry}, not {time} s");
        }
    }
    assert_eq!(series.matches(".vtu").count(), 2 * times.len().div_ceil(8));
    let stopped = scratch.ale_gear(["run", "a.toml", "--out", "o", "--stop-after-cycles", "1"]);
    assert_eq!(stopped.code, Some(2));
    assert!(stopped.stderr.contains("this analysis in time writes no ParaView files"), "{}", stopped.stderr);
}

/// Checkpoints that are not there, or belong to another scene, are no way to go on.
#[test]
fn a_foreign_checkpoint_is_refused() {
    let scratch = Scratch::new().file("a.toml", scene(2, ""));
    let none = scratch.command(&["run", "a.toml", "--out", "o", "--resume"]);
    assert!(none.stderr.starts_with("ale-gear: o.checkpoint/state.json: there is no checkpoint: "), "{}", none.stderr);
    assert_eq!(none.code, Some(2));
    assert_eq!(scratch.command(&["run", "a.toml", "--out", "o", "--stop-after-cycles", "1"]).code, Some(0));
    let file = scratch.file("f.checkpoint", "mine");
    let taken = file.command(&["run", "a.toml", "--out", "f", "--stop-after-cycles", "1"]);
    assert!(taken.stderr.starts_with("ale-gear: f.checkpoint: is there, and was not made by"), "{}", taken.stderr);
    assert_eq!(file.read("f.checkpoint"), "mine");
    let scratch = file.file("a.toml", scene(2, "mesh_damping_ratio = 0.07\n"));
    let other = scratch.command(&["run", "a.toml", "--out", "o", "--resume"]);
    assert_eq!(
        other.stderr,
        "ale-gear: a.toml: the checkpoint belongs to another scene: `motion.mesh_damping_ratio` was 0.05 and is 0.07\nhint: go on with what it belongs to, give another `--out`, or run without `--resume` to start from the beginning\n"
    );
}
