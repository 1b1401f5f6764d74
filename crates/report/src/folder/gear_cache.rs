//! Reduced gears and maps of their contact on disk, so that a second run of the same gears starts at once.

use std::{
    fs::{self, File},
    path::{Path, PathBuf},
    time::{Duration, SystemTime},
};

use analysis::{GearCache, MapKey};
use contact_map::ContactMap;
use reduction::{RecordKey, ReductionRecord};

use super::Partial;

/// A folder of reduced gears and maps, or none.
///
/// Losing the folder loses time, never a result: a file that is damaged, foreign or of another version is told of and
/// made again, and one that cannot be written is left out.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Cache {
    folder: Option<PathBuf>,
}

/// What the folder may hold, bytes; the files that were not used for the longest time go first.
const LIMIT: u64 = 4_000_000_000;
/// Suffixes of the files: of gears and of maps.
const SUFFIX: &str = "reduced";
const MAP_SUFFIX: &str = "map";
/// And of those that are being written, before the number of the process.
const TORN: &str = "partial-";
/// Nobody writes for so long.
const LONGEST_WRITE: Duration = Duration::from_secs(24 * 3600);

impl Cache {
    /// Nothing is read or written.
    pub fn off() -> Self {
        Self { folder: None }
    }

    /// A folder, made when first written into.
    pub fn in_folder(folder: PathBuf) -> Self {
        Self { folder: Some(folder) }
    }

    /// The user's cache folder (`$XDG_CACHE_HOME/ale-gear`, `~/.cache/ale-gear`, or what the system has in its place);
    /// none where the system names none.
    pub fn of_user() -> Self {
        Self { folder: directories::ProjectDirs::from("", "", "ale-gear").map(|p| p.cache_dir().to_owned()) }
    }

    /// Where the record of a key is kept, there or not; `None` without a folder.
    pub fn file(&self, key: &RecordKey) -> Option<PathBuf> {
        Some(self.folder.as_ref()?.join(format!("{key}.{SUFFIX}")))
    }

    fn map_file(&self, key: &MapKey) -> Option<PathBuf> {
        Some(self.folder.as_ref()?.join(format!("{key}.{MAP_SUFFIX}")))
    }

    /// Beside its place first, then renamed: whoever reads sees a whole file or none.
    fn write(&self, file: &Path, bytes: &[u8]) -> std::io::Result<()> {
        let Some(folder) = &self.folder else { return Ok(()) };
        fs::create_dir_all(folder)?;
        let partial = Partial::new(file.with_extension(format!("{TORN}{}", std::process::id())));
        fs::write(partial.path(), bytes)?;
        fs::rename(partial.path(), file)?;
        partial.keep();
        forget_torn(folder);
        make_room(folder, file);
        Ok(())
    }
}

impl GearCache for Cache {
    fn is_on(&self) -> bool {
        self.folder.is_some()
    }

    fn load(&self, key: &RecordKey) -> (Option<ReductionRecord>, Option<String>) {
        let Some(file) = self.file(key) else { return (None, None) };
        let bytes = match fs::read(&file) {
            Ok(bytes) => bytes,
            Err(e) if e.kind() == std::io::ErrorKind::NotFound => return (None, None),
            Err(e) => return (None, Some(format!("{}: {e}; the gear was reduced again", file.display()))),
        };
        match ReductionRecord::from_bytes(&bytes, key) {
            Ok(record) => {
                touch(&file);
                (Some(record), None)
            }
            Err(e) => (None, Some(format!("{}: {e}; the gear was reduced again", file.display()))),
        }
    }

    fn save(&self, key: &RecordKey, record: &ReductionRecord) -> Option<String> {
        let file = self.file(key)?;
        let written = self.write(&file, &record.to_bytes(key));
        written.err().map(|e| format!("{}: {e}; the next run will reduce the gear again", file.display()))
    }

    fn load_maps(&self, key: &MapKey) -> (Option<Vec<ContactMap>>, Option<String>) {
        let Some(file) = self.map_file(key) else { return (None, None) };
        let complain = |what: String| (None, Some(format!("{}: {what}; the contact was mapped again", file.display())));
        match fs::read(&file) {
            Ok(bytes) => match maps_from(&bytes) {
                Some(maps) => {
                    touch(&file);
                    (Some(maps), None)
                }
                None => complain("damaged".into()),
            },
            Err(e) if e.kind() == std::io::ErrorKind::NotFound => (None, None),
            Err(e) => complain(e.to_string()),
        }
    }

    fn save_maps(&self, key: &MapKey, maps: &[&ContactMap]) -> Option<String> {
        let file = self.map_file(key)?;
        let written = map_bytes(maps).map_err(std::io::Error::other).and_then(|bytes| self.write(&file, &bytes));
        written.err().map(|e| format!("{}: {e}; the next run will map the contact again", file.display()))
    }
}

/// Maps as JSON, which keeps every digit, after a line with its BLAKE3.
fn map_bytes(maps: &[&ContactMap]) -> Result<Vec<u8>, serde_json::Error> {
    let text = serde_json::to_string(maps)?;
    Ok(format!("{}\n{text}", blake3::hash(text.as_bytes()).to_hex()).into_bytes())
}

/// Maps that [`map_bytes`] wrote; `None` of anything else.
fn maps_from(bytes: &[u8]) -> Option<Vec<ContactMap>> {
    let (digest, text) = std::str::from_utf8(bytes).ok()?.split_once('\n')?;
    let sound = blake3::hash(text.as_bytes()).to_hex().as_str() == digest;
    serde_json::from_str(text).ok().filter(|_| sound)
}

/// Marks a file as used now. Where the system does not let it, the file is only taken for older than it is.
fn touch(file: &Path) {
    let _ = File::options().append(true).open(file).and_then(|f| f.set_modified(SystemTime::now()));
}

/// Removes what killed processes have left half written.
fn forget_torn(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for path in entries.flatten().map(|entry| entry.path()) {
        let of_process = |e: &str| e.strip_prefix(TORN).is_some_and(|n| n.bytes().all(|b| b.is_ascii_digit()));
        let ours = path.extension().and_then(|e| e.to_str()).is_some_and(of_process);
        let since = fs::metadata(&path).and_then(|data| data.modified()).ok().and_then(|t| t.elapsed().ok());
        if ours && since.is_some_and(|age| age > LONGEST_WRITE) {
            let _ = fs::remove_file(path);
        }
    }
}

/// Removes the least recently used files until the rest is within the limit; `newest` stays.
fn make_room(folder: &Path, newest: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    let mut files: Vec<(SystemTime, u64, PathBuf)> = entries
        .filter_map(|entry| {
            let path = entry.ok()?.path();
            let data = fs::metadata(&path).ok()?;
            let ours = path.extension().is_some_and(|e| e == SUFFIX || e == MAP_SUFFIX) && path != newest;
            ours.then_some((data.modified().ok()?, data.len(), path))
        })
        .collect();
    files.sort();
    let mut total: u64 = files.iter().map(|f| f.1).sum();
    for (_, size, path) in files {
        if total <= LIMIT {
            break;
        }
        // Another run may have removed it first.
        let _ = fs::remove_file(path);
        total -= size;
    }
}
