//! `ale-gear serve` in a browser: a slider is moved and the curve follows. Pictures stay in `target/tmp/page`.

use std::{
    io::{BufRead, BufReader, Read, Write},
    path::{Path, PathBuf},
    process::{Child, ChildStdout, Stdio},
};

use serde_json::{Value, json};

use super::devtools::Tab;
use super::util::{Scratch, repository};

/// WebGL without a graphics card, and no way to anywhere but this machine.
const FLAGS: [&str; 9] = [
    "--headless=new",
    "--no-sandbox",
    "--disable-dev-shm-usage",
    "--hide-scrollbars",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--proxy-server=127.0.0.1:9",
    "--proxy-bypass-list=127.0.0.1",
];
/// Frames are put together without WebGL, as the browser does by itself where there is no graphics card: done by
/// SwiftShader, a frame takes 75 ms of both cores.
const WITHOUT_GL: &str = "--disable-gpu-compositing";
/// Moves of the slider that are timed.
const MOVES: u32 = 200;

/// The command at work, and the address that it has told.
struct Serving(Child, BufReader<ChildStdout>, String);

impl Serving {
    fn new(scratch: &Scratch, words: &[&str]) -> Self {
        let mut command = scratch.program();
        command.args(["serve", "--no-browser"]).args(words).stdout(Stdio::piped()).stderr(Stdio::null());
        let mut child = command.spawn().unwrap();
        let mut said = BufReader::new(child.stdout.take().unwrap());
        let mut address = String::new();
        said.read_line(&mut address).unwrap();
        Self(child, said, address.trim().to_owned())
    }
}

impl Drop for Serving {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// The page of the default pair, solved once.
fn opened(browser: &Path, flags: &[&str], scratch: &Scratch) -> (Serving, Tab) {
    let serving = Serving::new(scratch, &[&repository().join("scenes/default.toml").display().to_string()]);
    let mut tab = Tab::open(browser, flags, scratch);
    tab.window([1400, 1000], false);
    tab.call("Page.navigate", json!({ "url": serving.2 }));
    tab.ask("new Promise(done => { const look = () => window.page ? done(1) : setTimeout(look, 20); look(); })");
    tab.ask(SETTLED);
    (serving, tab)
}

/// A file that solves in the browser: the numbers of the program, before and after a move.
pub fn by_itself(browser: PathBuf, file: &Path) {
    let scratch = Scratch::new();
    let mut tab = Tab::open(&browser, &[&FLAGS[..], &[WITHOUT_GL]].concat(), &scratch);
    tab.window([1400, 1000], false);
    tab.call("Page.navigate", json!({ "url": format!("file://{}", file.display()) }));
    tab.ask("new Promise(done => { const look = () => window.page ? done(1) : setTimeout(look, 20); look(); })");
    tab.ask(SETTLED);
    slide(&mut tab, "operation.torque_nm", 0.3);
    assert_eq!(tab.ask("document.getElementById('fault').hidden"), true);
    let shown = tab.ask("document.getElementById('glance').textContent");
    let scratch = scratch.file("moved.toml", handed_out(&mut tab));
    let run = scratch.ale_gear(["run", "moved.toml", "--out", "o", "--no-view"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let headline: Value = serde_json::from_str(&scratch.read("o/summary.json")).unwrap();
    let mean = headline["headline"]["mean_ste_um"].as_f64().unwrap();
    assert!(shown.as_str().unwrap().contains(&format!("mean STE{mean:.2}")), "{mean} beside {shown}");
    assert!(tab.complaints.is_empty(), "{:#?}", tab.complaints);
}

/// Waits until what is moved is shown.
const SETTLED: &str = "new Promise(done => { const look = () => { \
    const { moves, drawn } = window.page, last = drawn.at(-1); \
    if (moves.under === 0 && !moves.waits && (last?.number === moves.made || !document.getElementById('fault').hidden)) done(true); else setTimeout(look, 20); }; look(); })";

/// Whether nothing is wider than the window, once everything has taken its width.
const FITS: &str = "new Promise(done => { let looks = 0; const look = () => { \
    const fits = document.documentElement.scrollWidth <= innerWidth; \
    if ((fits && looks > 5) || looks > 100) done(fits); else { looks += 1; setTimeout(look, 60); } }; look(); })";

/// Moves the slider of a key to a share of its way.
fn slide(tab: &mut Tab, key: &str, share: f64) {
    tab.ask(&format!(
        "(() => {{ const range = document.getElementById('slider-{key}'); \
         range.value = Number(range.min) + {share} * (range.max - range.min); range.dispatchEvent(new Event('input')); }})()"
    ));
    tab.ask(SETTLED);
}

/// What stands in a key of the scene that is handed out.
fn handed_out(tab: &mut Tab) -> String {
    tab.ask("document.getElementById('text').value").as_str().unwrap().to_owned()
}

/// Ordinates of the curve of the transmission error.
fn curve(tab: &mut Tab) -> Vec<f64> {
    let of_page = tab.ask("window.report.charts[0][0].data[1]");
    of_page.as_array().unwrap().iter().filter_map(Value::as_f64).collect()
}

fn peak_to_peak(curve: &[f64]) -> f64 {
    let ends = curve.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(*v), h.max(*v)]);
    ends[1] - ends[0]
}

fn keep(tab: &mut Tab, name: &str) {
    let pictures = pictures();
    std::fs::write(pictures.join(format!("{name}.png")), tab.picture()).unwrap();
}

fn pictures() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("page");
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// A slider moves curve, text and pattern; a run of the text that is handed out has the numbers that are shown; what is
/// wrong stands beside its key.
pub fn a_moved_slider(browser: PathBuf) {
    let scratch = Scratch::new();
    let (_serving, mut tab) = opened(&browser, &FLAGS, &scratch);
    let before = curve(&mut tab);
    assert_eq!(before.len(), 32, "a place a position");
    slide(&mut tab, "operation.torque_nm", 0.8);
    let heavier = curve(&mut tab);
    assert!(heavier[0] > 1.3 * before[0], "240 in place of 150 N m: STE {} and {} um", before[0], heavier[0]);
    assert!(handed_out(&mut tab).contains("torque_nm = 240"), "{}", handed_out(&mut tab));
    slide(&mut tab, "pinion.modification.lead_crowning_um", 0.5);
    let crowned = curve(&mut tab);
    assert!(peak_to_peak(&crowned) != peak_to_peak(&heavier), "crowning changes nothing");
    let text = handed_out(&mut tab).replace("../meshes", &repository().join("meshes").display().to_string());
    let scratch = scratch.file("moved.toml", text);
    let run = scratch.ale_gear(["run", "moved.toml", "--out", "o", "-q"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let of_run = super::util::column(&scratch.read("o/history.csv"), "ste_um");
    for (shown, run) in crowned.iter().zip(&of_run) {
        assert!((shown - run).abs() <= 1e-5 * run, "the page draws {shown} um, the run has {run}");
    }
    wrong_key(&mut tab);
    keyboard(&mut tab);
    for (width, height) in [(1400, 1000), (500, 900)] {
        for dark in [false, true] {
            tab.window([width, height], dark);
            assert_eq!(tab.ask(FITS), Value::Bool(true), "{width} px: wider than the window");
            let name = format!("{width}_{}", if dark { "dark" } else { "light" });
            keep(&mut tab, &name);
            in_space(&mut tab);
            keep(&mut tab, &format!("{name}_below"));
            if width == 1400 {
                tab.ask("document.querySelector('[data-look=mesh]').click(); document.getElementById('stage').scrollIntoView()");
                keep(&mut tab, &format!("{name}_mesh"));
                tab.ask("document.querySelector('[data-look=whole]').click()");
            }
            tab.ask("scrollTo(0, 0)");
        }
    }
    assert!(tab.complaints.is_empty(), "{:#?}", tab.complaints);
}

/// Further down, pattern and gears are drawn when they come into sight.
fn in_space(tab: &mut Tab) {
    tab.ask("document.getElementById('pattern').scrollIntoView()");
    tab.ask("new Promise(done => { const look = () => window.report.view?.state.shown > 1 ? setTimeout(done, 500) : setTimeout(look, 20); look(); })");
    assert_eq!(tab.ask("window.report.failed ?? ''"), "", "no picture in space");
    let pattern = tab.ask("document.querySelectorAll('#pattern canvas').length");
    assert_eq!(pattern, 2, "a map of either flank");
}

/// A number out of its range: message and hint beside the key, the curve stays; then it is mended.
fn wrong_key(tab: &mut Tab) {
    let before = curve(tab);
    let typed = |tab: &mut Tab, value: &str| {
        tab.ask(&format!(
            "(() => {{ const field = document.getElementById('key-pair.normal_pressure_angle_deg'); \
             field.value = '{value}'; field.dispatchEvent(new Event('change')); }})()"
        ));
        tab.ask(SETTLED);
        tab.ask(
            "document.querySelector('.row[data-key=\"pair.normal_pressure_angle_deg\"] .complaint')?.textContent ?? ''",
        )
    };
    let said = typed(tab, "80");
    let said = said.as_str().unwrap();
    assert!(said.contains("`normal_pressure_angle_deg` is 80, allowed is 5 .. 40"), "{said}");
    assert_eq!(
        tab.ask("document.getElementById('key-pair.normal_pressure_angle_deg').getAttribute('aria-invalid')"),
        "true"
    );
    assert_eq!(curve(tab), before, "the last curve stays");
    assert_eq!(typed(tab, ""), "", "mended");
}

/// The arrow keys move a slider as a mouse does; each has a name, a unit and a number to type.
fn keyboard(tab: &mut Tab) {
    let before = handed_out(tab);
    tab.ask("document.getElementById('slider-operation.torque_nm').focus()");
    for kind in ["keyDown", "keyUp"] {
        let key = json!({ "type": kind, "key": "ArrowRight", "code": "ArrowRight", "windowsVirtualKeyCode": 39 });
        tab.call("Input.dispatchKeyEvent", key);
    }
    tab.ask(SETTLED);
    assert_ne!(handed_out(tab), before, "the arrow key moves nothing");
    let bare = tab.ask(
        "[...document.querySelectorAll('input[type=range]')].filter(i => !i.labels.length || \
         (i.id.startsWith('slider-') && i.getAttribute('aria-valuetext').split(' ').length < 2)).map(i => i.id)",
    );
    assert_eq!(bare, json!([]), "sliders without name or unit");
}

/// How long a curve takes to follow; told, not judged, as no test may depend on how fast the machine is.
pub fn two_hundred_moves(browser: PathBuf) {
    let scratch = Scratch::new();
    let flags = [&FLAGS[..], &[WITHOUT_GL]].concat();
    let (_serving, mut tab) = opened(&browser, &flags, &scratch);
    for k in 0..MOVES {
        slide(&mut tab, "pinion.modification.lead_crowning_um", f64::from(k % 50) / 49.0);
    }
    let drawn = tab.ask("window.page.drawn");
    let of = |key: &str| {
        let all = drawn.as_array().unwrap().iter().rev().take(MOVES as usize);
        let mut all: Vec<f64> = all.filter_map(|move_| move_[key].as_f64()).collect();
        all.sort_by(f64::total_cmp);
        [all[all.len() / 2], all[all.len() * 19 / 20], all[all.len() - 1]]
    };
    let [curve, came, solve] = ["after_ms", "came_ms", "solve_ms"].map(of);
    assert_eq!(drawn.as_array().unwrap().len(), MOVES as usize + 1, "every move is drawn");
    let told = format!(
        "slider to curve, {MOVES} moves, ms: median {:.0}, p95 {:.0}, largest {:.0}; answered after {:.0}, {:.0}, {:.0}, \
         of that solved in {:.0}, {:.0}, {:.0}\n",
        curve[0], curve[1], curve[2], came[0], came[1], came[2], solve[0], solve[1], solve[2]
    );
    std::fs::write(pictures().join("moves.txt"), &told).unwrap();
    let _ = std::io::stderr().write_all(told.as_bytes());
}

/// Ctrl-C ends the command with status 0 and no word of complaint.
pub fn ends_cleanly() {
    let scratch = Scratch::new().file("a.toml", super::util::ISO_SCENE);
    let mut serving = Serving::new(&scratch, &["a.toml"]);
    assert!(serving.2.starts_with("http://127.0.0.1:"), "{}", serving.2);
    let stopped = std::process::Command::new("kill").args(["-INT", &serving.0.id().to_string()]).status().unwrap();
    assert!(stopped.success());
    let status = serving.0.wait().unwrap();
    let mut rest = String::new();
    serving.1.read_to_string(&mut rest).unwrap();
    assert_eq!((status.code(), rest.as_str()), (Some(0), ""));
}
