//! What the program keeps in files and reads back.

use std::{io::Write, path::Path, sync::OnceLock};

use analysis::motion::{MotionCheckpoint, MotionLayout};
use answer::Table;
use columns::columns_to_csv;
use columns::parse_columns;
use flate2::{Compression, write::GzEncoder};
use reduction::{RecordKey, ReductionRecord};
use report::{
    compare::{Axis, ResultFolder, compare_answer, compare_charts, compare_page, headline_rows, input_rows, overlays},
    page::{closing_text, report_from},
};
use scene::Scene;
use store::checkpoint::{GearboxState, PairState, Stored, parse_rows, sealed_state};
use study::Touch;

use super::halves;

/// Bytes before the payload of a record, as `crates/reduction/src/record/format.md` has them: length and checksum stand last.
const HEADER: usize = 92;

/// The payload of a record. Length and checksum are made to fit, else nothing would ever come past them; what bears
/// a header of its own is read as it is, too.
pub fn record(bytes: &[u8]) {
    let read = |file: &[u8]| {
        let key = RecordKey::in_file(file)?;
        let record = ReductionRecord::from_bytes(file, &key).map_err(|e| drop((e.to_string(), e.hint()))).ok()?;
        // What was read is what is written again.
        assert!(record.to_bytes(&key).len() == file.len(), "a record of another length");
        Some(())
    };
    read(bytes);
    read(&sealed_record(bytes));
}

/// The file of a payload: version 2, a key of zeros, length and checksum.
pub fn sealed_record(payload: &[u8]) -> Vec<u8> {
    let mut file = b"ale-gear reduced".to_vec();
    file.extend(reduction::RECORD_VERSION.to_le_bytes());
    file.extend([0; 32]);
    file.extend((payload.len() as u64).to_le_bytes());
    let mut hasher = blake3::Hasher::new();
    hasher.update(&file).update(payload);
    file.extend(hasher.finalize().as_bytes());
    assert_eq!(file.len(), HEADER);
    file.extend(payload);
    file
}

/// The state of a checkpoint, with the digest that it should have; as it is, too.
pub fn checkpoint(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let read = |text: &str| {
        let names = [Path::new("state.json"), Path::new("fuzz.toml")];
        match Stored::<PairState>::parse(text, names[0], names[1]) {
            Ok(stored) => gone_on_from(stored.state.checkpoint()),
            Err(e) => drop((e.to_string(), e.hint())),
        }
        let _ = Stored::<GearboxState>::parse(text, names[0], names[1]).map_err(|e| drop((e.to_string(), e.hint())));
    };
    read(text);
    read(&sealed_state(text));
}

/// What a run does with a checkpoint before it moves anything.
fn gone_on_from(checkpoint: MotionCheckpoint) {
    let Some(scene) = small_scene() else { return };
    drop(MotionLayout::of(scene, checkpoint.window).pairs().collect::<Vec<_>>());
    let touch = Touch { z: 0.0, engagement: 0.5, roll: 0.3, pressure: 1.0, line_load: 1.0 };
    for mut pattern in checkpoint.patterns {
        let _ = pattern.press(&[touch, Touch { roll: 0.5, ..touch }], 1.0);
    }
}

/// The source of a report's page. It is packed first, else nothing would come past the checksum; as it is, too.
pub fn page(bytes: &[u8]) {
    for packed in [bytes, &packed(bytes)] {
        if let Err(e) = report_from(packed, Path::new("report.json.gz")) {
            drop((e.to_string(), e.hint()));
        }
    }
}

/// Bytes in gzip.
fn packed(bytes: &[u8]) -> Vec<u8> {
    let mut packed = GzEncoder::new(Vec::new(), Compression::fast());
    // Writing to memory cannot fail.
    let _ = packed.write_all(bytes);
    packed.finish().unwrap_or_default()
}

/// A scene to lay out rows by.
fn small_scene() -> Option<&'static Scene> {
    static SCENE: OnceLock<Option<Scene>> = OnceLock::new();
    SCENE.get_or_init(|| Scene::default_scene().ok()).as_ref()
}

/// Rows: `history.csv` before the first zero byte, `energy.csv` behind it.
pub fn rows(bytes: &[u8]) {
    let (history, energy) = halves(bytes);
    let Ok(history) = std::str::from_utf8(history) else { return };
    if let Some(columns) = parse_columns(history) {
        drop(columns_to_csv(&columns));
        let _ = columns.is_finite();
    }
    let Some(Ok(energy)) = energy.map(std::str::from_utf8) else { return };
    let Some(scene) = small_scene() else { return };
    let _ = parse_rows(&MotionLayout::of(scene, 3), [history, energy], Path::new("out")).map_err(|e| e.to_string());
}

/// Two result folders beside each other: `summary.json` before the first zero byte, rows behind it, both runs alike
/// but for the second one's rows, which stand behind a second zero byte.
pub fn results(bytes: &[u8]) {
    let (summary, rest) = halves(bytes);
    let (first, second) = rest.map_or((None, None), |rest| {
        let (first, second) = halves(rest);
        (Some(first), second.or(Some(first)))
    });
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).ok();
    let Some(summary) = text(summary) else { return };
    let folder = |name: &str, rows: Option<&[u8]>| {
        let rows = rows.and_then(text);
        ResultFolder::parse(Path::new(name), &summary, rows.as_deref()).map_err(|e| drop((e.to_string(), e.hint())))
    };
    let (Ok(first), Ok(second)) = (folder("a", first), folder("b", second)) else { return };
    let runs = [first, second];
    let (numbers, inputs) = (headline_rows(&runs), input_rows(&runs));
    for axis in [Axis::Phase, Axis::Time] {
        let curves = overlays(&runs, axis);
        let answer = compare_answer(&runs, &numbers, &inputs, &curves);
        let page = compare_page(&answer, &runs, (&numbers, &inputs), &compare_charts(&curves));
        drop((closing_text(&page, &answer.cost), answer.tables.iter().map(Table::csv).collect::<Vec<_>>()));
    }
}
