//! Reports in a browser: they open without complaint, draw their charts and the gears, and their slider moves them.
//!
//! Pictures stay in `target/tmp/report`.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

use serde_json::Value;

use super::util::{ISO_SCENE, Scratch, motion_scene, repository};

/// WebGL without a graphics card, and nothing fetched from anywhere.
const FLAGS: [&str; 11] = [
    "--headless=new",
    "--dump-dom",
    "--hide-scrollbars",
    "--no-sandbox",
    "--disable-dev-shm-usage",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--proxy-server=127.0.0.1:9",
    "--enable-logging=stderr",
    "--virtual-time-budget=5000",
];
/// Widths and heights of windows, pixels; the browser has no narrower one.
const DESK: [u32; 2] = [1280, 3600];
const PHONE: [u32; 2] = [500, 5200];
/// Largest report, bytes.
const LARGEST: u64 = 6_000_000;

/// Looks at the page from inside, and leaves what it saw in an element of its own.
const SELF_CHECK: &str = r##"<script>
addEventListener("load", async () => {
  const seen = { charts: [], failed: window.report?.failed ?? null };
  // Colours of a canvas other than its corner's.
  const marks = canvas => {
    const copy = document.createElement("canvas"), pen = copy.getContext("2d", { willReadFrequently: true });
    [copy.width, copy.height] = [canvas.width, canvas.height];
    pen.drawImage(canvas, 0, 0);
    const all = new Uint32Array(pen.getImageData(0, 0, copy.width, copy.height).data.buffer), corner = all[0];
    let sum = 0, different = 0;
    all.forEach((pixel, i) => { if (pixel !== corner) { different += 1; sum = (sum * 31 + pixel * (i % 8191)) >>> 0; } });
    return { different, sum };
  };
  for (const canvas of document.querySelectorAll("figure.chart canvas")) seen.charts.push(marks(canvas).different);
  // Marks of axes that say another number than the one they stand at: 0.03 for 0.025.
  seen.marks = (window.report?.charts ?? []).flatMap(([chart]) => chart.axes.flatMap(axis => {
    const at = axis._splits ?? [], step = Math.abs((at[1] ?? 1) - (at[0] ?? 0));
    return at.flatMap((v, i) => v === null || !axis._values?.[i] || Math.abs(Number(axis._values[i]) - v) <= 0.02 * step ? [] : [`${axis._values[i]} at ${v}`]);
  }));
  seen.figures = document.querySelectorAll("figure.chart script").length;
  const stage = document.querySelector("#stage canvas"), slider = document.getElementById("frame");
  if (stage && slider) {
    const steps = Number(slider.max) + 1, go = k => { slider.value = k; slider.dispatchEvent(new Event("input")); };
    seen.steps = steps;
    seen.gears = marks(stage).different;
    const before = marks(stage).sum;
    go(Math.floor(steps / 2));
    seen.moved = marks(stage).sum !== before;
    seen.phase = document.getElementById("phase").textContent;
    seen.quantities = [...document.querySelectorAll("#quantity input")].map(input => {
      if (input.disabled) return [input.value, null];
      input.click();
      return [input.value, marks(stage).sum];
    });
  }
  // The picture that is kept shows the first field at the first position.
  document.querySelector("#quantity input:not(:disabled)")?.click();
  document.querySelector("[data-look=mesh]")?.click();
  // The still picture of every chart in pixels, as "save as PNG" hands it out.
  // A drawing may have drawings in it.
  const stills = [...document.querySelectorAll("figure.chart svg:not(svg svg)")];
  seen.links = [document.querySelectorAll("figure.chart a.png").length, stills.length];
  seen.stills = [];
  for (const still of stills) {
    const drawn = new Image();
    const picture = await window.report.pixels(still);
    await new Promise(done => { drawn.onload = done; drawn.src = picture; });
    seen.stills.push(drawn.src.startsWith("data:image/png;base64,") ? marks(drawn).different : 0);
  }
  // Other machines have wider letters: the page must bear them too. What stands out of the window is named.
  seen.wide = ["", ".05em"].flatMap(spacing => {
    document.body.style.letterSpacing = spacing;
    if (document.documentElement.scrollWidth <= innerWidth) return [];
    const out = [...document.querySelectorAll("body *")].filter(e => e.getBoundingClientRect().right > innerWidth && !e.closest(".scroll, .section, .live"));
    const names = out.slice(0, 8).map(e => `<${e.localName} class="${e.className}"> ${e.textContent.slice(0, 60)}`);
    return [`${document.documentElement.scrollWidth} pixels, letters apart by "${spacing}"`, ...names];
  });
  document.body.style.letterSpacing = "";
  const answer = document.createElement("pre");
  answer.hidden = true;
  answer.textContent = "SEEN" + JSON.stringify(seen) + "END";
  document.body.append(answer);
});
</script>"##;

/// A page takes some fifteen seconds; this is for machines that are much slower, or busy.
const PATIENCE: Duration = Duration::from_secs(120);
/// A browser whose virtual time stands still, as it does now and then on a busy machine, is opened again.
const TRIES: usize = 6;

/// The page as the browser leaves it, and what it says.
fn opened(scratch: &Scratch, browser: &Path, args: &[String]) -> [String; 2] {
    for at in 0..TRIES {
        let [page, said] = ["page", "said"].map(|name| scratch.path().join(format!("{name}_{at}")));
        let mut running = Command::new(browser)
            .args(FLAGS)
            .arg(format!("--user-data-dir={}", scratch.path().join(format!("profile_{at}")).display()))
            .args(args)
            .stdout(File::create(&page).unwrap())
            .stderr(File::create(&said).unwrap())
            .spawn()
            .unwrap();
        let begin = Instant::now();
        while begin.elapsed() < PATIENCE {
            if running.try_wait().unwrap().is_some() {
                return [page, said].map(|file| String::from_utf8_lossy(&std::fs::read(file).unwrap()).into_owned());
            }
            std::thread::sleep(Duration::from_millis(20));
        }
        running.kill().unwrap();
        running.wait().unwrap();
    }
    panic!("the browser stands still")
}

/// Opens the report of a run in a window of some width and keeps a picture; what the page saw of itself comes back.
fn look(scratch: &Scratch, browser: &Path, file: &str, name: &str, [width, height]: [u32; 2]) -> Value {
    let bytes = std::fs::metadata(scratch.path().join(file)).unwrap().len();
    assert!(bytes < LARGEST, "{name}: the report has {bytes} bytes");
    let page = scratch.read(file);
    assert!(!page.contains("src=\"http") && !page.contains("href=\"http"), "{name}: the report needs a network");
    let checked = scratch.path().join("checked.html");
    std::fs::write(&checked, page.replacen("</body>", &format!("{SELF_CHECK}</body>"), 1)).unwrap();
    let pictures = Path::new(env!("CARGO_TARGET_TMPDIR")).join("report");
    std::fs::create_dir_all(&pictures).unwrap();
    let args = [
        format!("--window-size={width},{height}"),
        format!("--screenshot={}", pictures.join(format!("{name}_{width}.png")).display()),
        format!("file://{}", checked.display()),
    ];
    let [text, said] = opened(scratch, browser, &args);
    let complaints: Vec<&str> = said.lines().filter(|l| l.contains(":CONSOLE")).collect();
    assert!(complaints.is_empty(), "{name}: the console says {complaints:#?}");
    // The script itself has no brace after the word.
    let seen = text.split_once("SEEN{").and_then(|(_, rest)| rest.split_once("}END"));
    let seen = format!("{{{}}}", seen.unwrap_or_else(|| panic!("{name}: the page did not finish: {said}")).0);
    serde_json::from_str(&seen).unwrap()
}

/// What holds for every page: charts are drawn, their marks tell them apart, nothing is wider than the window.
fn check_charts(seen: &Value, name: &str) {
    let charts: Vec<u64> = seen["charts"].as_array().unwrap().iter().map(|c| c.as_u64().unwrap()).collect();
    assert_eq!(charts.len() as u64, seen["figures"].as_u64().unwrap(), "{name}: every chart has a canvas");
    assert!(charts.len() >= 3 && charts.iter().all(|&c| c > 500), "{name}: pixels drawn in the charts: {charts:?}");
    assert_eq!(seen["links"][0], seen["links"][1], "{name}: every chart can be saved as PNG: {seen}");
    let stills = seen["stills"].as_array().unwrap();
    assert!(!stills.is_empty() && stills.iter().all(|s| s.as_u64() > Some(500)), "{name}: empty pictures: {stills:?}");
    assert_eq!(seen["wide"], serde_json::json!([]), "{name}: wider than the window");
    assert_eq!(seen["marks"], serde_json::json!([]), "{name}: marks of axes that do not stand where they say");
}

/// What holds for every report with gears in space.
fn check(seen: &Value, name: &str) {
    check_charts(seen, name);
    assert_eq!(seen["failed"], Value::Null, "{name}: no picture in space");
    let gears = seen["gears"].as_u64().unwrap();
    assert!(gears > 20_000, "{name}: the gears cover {gears} pixels");
    assert_eq!(seen["moved"], Value::Bool(true), "{name}: the slider moves nothing: {seen}");
}

/// Fields that the picture in space can show, each with another picture.
fn quantities(seen: &Value) -> Vec<String> {
    let shown = seen["quantities"].as_array().unwrap().iter().filter(|q| !q[1].is_null());
    let (names, mut sums): (Vec<String>, Vec<u64>) =
        shown.map(|q| (q[0].as_str().unwrap().to_owned(), q[1].as_u64().unwrap())).unzip();
    sums.sort_unstable();
    sums.dedup();
    assert_eq!(sums.len(), names.len(), "each field has a picture of its own: {seen}");
    names
}

/// Shafts, gears and bearings in space; a step through the positions turns and bends them.
pub fn gearbox(browser: PathBuf) {
    let scratch = Scratch::new();
    let stages = repository().join("scenes/gearbox/two_stages.toml").display().to_string();
    let done = scratch.ale_gear(["run", &stages, "--out", "o"]);
    assert_eq!(done.code, Some(0), "{}", done.stderr);
    for size in [DESK, PHONE] {
        let seen = look(&scratch, &browser, "o/report.html", "gearbox", size);
        check(&seen, "gearbox");
        assert_eq!(seen["steps"], 8, "a step a position: {seen}");
    }
}

/// The run of a scene; the browser looks at its report.
fn report_of(browser: &Path, name: &str, scene: &str) -> Value {
    let scratch = Scratch::new().file("a.toml", scene);
    let done = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert_eq!(done.code, Some(0), "{name}: {}", done.stderr);
    let seen = look(&scratch, browser, "o/report.html", name, DESK);
    check(&seen, name);
    if name == "static" {
        check(&look(&scratch, browser, "o/report.html", name, PHONE), "static on a phone");
    }
    seen
}

fn all() -> [String; 3] {
    ["pressure", "displacement", "stress"].map(String::from)
}

pub fn static_report(browser: PathBuf) {
    let meshes = repository().join("meshes");
    let scene = std::fs::read_to_string(repository().join("scenes/coarse.toml")).unwrap();
    let scene = scene.replace("../meshes", &meshes.display().to_string());
    let seen = report_of(&browser, "static", &scene);
    assert_eq!(quantities(&seen), all());
    assert_eq!(seen["charts"].as_array().unwrap().len(), 9, "seven charts and two flanks");
    assert_eq!((seen["steps"].as_u64(), seen["phase"].as_str()), (Some(16), Some("phase 0.500")));
}

pub fn motion(browser: PathBuf) {
    let seen = report_of(&browser, "motion", &motion_scene(4, ""));
    assert_eq!(quantities(&seen), all());
}

pub fn run_up(browser: PathBuf) {
    let ramp =
        "run = \"ramp\"\n[motion.ramp]\nfrom_rpm = 3000.0\nto_rpm = 9000.0\nduration_s = 0.04\nwaterfall_cycles = 4\n";
    let seen = report_of(&browser, "ramp", &motion_scene(0, ramp));
    assert_eq!(quantities(&seen), all());
}

pub fn without_meshes(browser: PathBuf) {
    let seen = report_of(&browser, "iso", ISO_SCENE);
    assert!(quantities(&seen).is_empty(), "{seen}");
    assert_eq!(seen["steps"].as_u64(), Some(16));
}

/// Runs commands and looks at a page of theirs.
fn page_of(browser: &Path, name: &str, scratch: &Scratch, commands: &[&[&str]], file: &str) -> Value {
    for words in commands {
        let done = scratch.command(words);
        assert_eq!(done.code, Some(0), "{name}: {}", done.stderr);
    }
    // One page of the three is looked at on a phone as well: style and scripts are the same.
    if name == "compare" {
        check_charts(&look(scratch, browser, file, name, PHONE), "compare on a phone");
    }
    look(scratch, browser, file, name, DESK)
}

pub fn sweep(browser: PathBuf) {
    let scene = std::fs::read_to_string(repository().join("scenes/seeds/004.toml")).unwrap();
    let scratch = Scratch::new().file("a.toml", scene);
    let sweep = ["vary", "a.toml", "--out", "o", "--vary", "operation.speed_rpm=800:1000:3", "--start", "carry"];
    let few = ["--cycles", "6", "--settle", "20", "--lyapunov", "5"];
    let seen = page_of(&browser, "sweep", &scratch, &[&[&sweep[..], &few[..]].concat()], "o/report.html");
    check(&seen, "sweep");
    assert_eq!(seen["charts"].as_array().unwrap().len(), 5, "diagram, peak to peak, exponent, force, mean");
}

pub fn studies(browser: PathBuf) {
    let study = "[[case]]\nscene = \"a.toml\"\nlabel = \"light\"\nvalue = 1\n[[case]]\nscene = \"a.toml\"\nlabel = \"heavy\"\nvalue = 2\nset = [\"operation.torque_nm=300\"]\n\
        [[quantity]]\ncolumn = \"ste_um\"\n[[over_time]]\ncolumn = \"contact_line_length_mm\"\n[[follow]]\ncolumn = \"ste_um\"\nbeside = [\"pairs_in_contact\"]\n";
    let scratch = Scratch::new().file("a.toml", ISO_SCENE).file("s.toml", study);
    let seen = page_of(&browser, "study", &scratch, &[&["run", "s.toml", "--out", "o"]], "o/report.html");
    check_charts(&seen, "study");
    let cases = ["o/cases/01-light", "o/cases/02-heavy"];
    let compare = ["compare", cases[0], cases[1], "--out", "c"];
    let seen = page_of(&browser, "compare", &scratch, &[&compare], "c/report.html");
    check_charts(&seen, "compare");
}
