//! Reduced gears and maps of their contact on disk, so that a second run of the same gears starts at once.

use std::{
    fs::{self, File},
    io::ErrorKind,
    path::{Path, PathBuf},
    sync::Arc,
    time::SystemTime,
};

use analysis::{
    GearCache, Kept, MAP_VERSION, MapKey, SOUND_VERSION, SoundKey,
    remark::{self, Remark},
};
use contact_map::ContactMap;
use files::{Kind, most, open_regular_file, read_regular_file, take_away_left_overs, write_file};
use reduction::{
    KeptFactor, PartFault, PartStore, RecordError, RecordKey, ReductionRecord, TableKey, ToothColumns, factor_bytes,
    read_factor, read_table, table_bytes,
};

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
/// Suffixes of the files: of gears, of columns of their teeth, of factors of their sectors, of tables, of maps.
const SUFFIX: &str = "reduced";
const COLUMNS_SUFFIX: &str = "columns";
const FACTOR_SUFFIX: &str = "factor";
const TABLE_SUFFIX: &str = "table";
const MAP_SUFFIX: &str = "map";
/// Suffix of a file that says that a mesh is sound, and its first words.
const SOUND_SUFFIX: &str = "sound";
const SOUND_HEADING: &str = "ale-gear sound mesh";
/// First word of a file of maps.
const MAP_HEADING: &str = "ale-gear maps";

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

    fn sound_file(&self, key: &SoundKey) -> Option<PathBuf> {
        Some(self.folder.as_ref()?.join(format!("{key}.{SOUND_SUFFIX}")))
    }

    fn map_file(&self, key: &MapKey) -> Option<PathBuf> {
        Some(self.folder.as_ref()?.join(format!("{key}.{MAP_SUFFIX}")))
    }

    /// Whoever reads sees a whole file or none.
    fn write(&self, file: &Path, bytes: &[u8]) -> std::io::Result<()> {
        let Some(folder) = &self.folder else { return Ok(()) };
        fs::create_dir_all(folder)?;
        take_away_left_overs(folder, &Kind::FILE);
        // A link or a pipe of that name was put there by somebody else, for whatever purpose.
        if fs::symlink_metadata(file).is_ok_and(|found| !found.is_file()) {
            return Err(std::io::Error::other("is not a regular file"));
        }
        write_file(file, bytes)?;
        make_room(folder, file);
        Ok(())
    }
}

impl GearCache for Cache {
    fn is_on(&self) -> bool {
        self.folder.is_some()
    }

    fn load(&self, key: &RecordKey) -> (Option<Kept<RecordKey, ReductionRecord>>, Option<Remark>) {
        let Some(file) = self.file(key) else { return (None, None) };
        let (from, length) = match open_regular_file(&file, most::RECORD) {
            Ok(opened) => opened,
            Err(e) if e.kind() == ErrorKind::NotFound => return (None, None),
            Err(e) => return (None, Some(remark::gear_not_loaded(file.display().to_string(), e.to_string()))),
        };
        match ReductionRecord::read(from, length as usize, key) {
            Ok(record) => {
                touch(&file);
                (Some(Kept::new(*key, record)), None)
            }
            Err(e) => (None, Some(remark::gear_not_loaded(file.display().to_string(), e.to_string()))),
        }
    }

    fn save(&self, key: &RecordKey, record: &ReductionRecord) -> Option<Remark> {
        let file = self.file(key)?;
        let written = self.write(&file, &record.to_bytes(key));
        written.err().map(|e| remark::gear_not_stored(file.display().to_string(), e.to_string()))
    }

    fn parts(&self, key: &RecordKey) -> Option<Arc<dyn PartStore>> {
        self.folder.is_some().then(|| Arc::new(PartsOnDisk { cache: self.clone(), key: *key }) as Arc<dyn PartStore>)
    }

    fn is_sound(&self, key: &SoundKey) -> bool {
        let Some(file) = self.sound_file(key) else { return false };
        let text = sound_text(key);
        // A file with anything else in it is as good as none.
        let found = read_regular_file(&file, text.len() as u64).is_ok_and(|bytes| bytes == text.as_bytes());
        if found {
            touch(&file);
        }
        found
    }

    fn keep_sound(&self, key: &SoundKey) {
        if let Some(file) = self.sound_file(key) {
            // Where it cannot be written the mesh is checked again.
            let _ = self.write(&file, sound_text(key).as_bytes());
        }
    }

    fn load_maps(&self, key: &MapKey) -> (Option<Kept<MapKey, Vec<ContactMap>>>, Option<Remark>) {
        let Some(file) = self.map_file(key) else { return (None, None) };
        let complain = |what: String| (None, Some(remark::map_not_loaded(file.display().to_string(), what)));
        match read_regular_file(&file, most::RECORD) {
            Ok(bytes) => match maps_from(&bytes, key) {
                Ok(maps) => {
                    touch(&file);
                    (Some(Kept::new(*key, maps)), None)
                }
                Err(what) => complain(what.into()),
            },
            Err(e) if e.kind() == ErrorKind::NotFound => (None, None),
            Err(e) => complain(e.to_string()),
        }
    }

    fn save_maps(&self, key: &MapKey, maps: &[&ContactMap]) -> Option<Remark> {
        let file = self.map_file(key)?;
        let written = map_bytes(key, maps).map_err(std::io::Error::other).and_then(|bytes| self.write(&file, &bytes));
        written.err().map(|e| remark::map_not_stored(file.display().to_string(), e.to_string()))
    }
}

/// Columns of the teeth of one gear, a file each, the factor of its sector, tables.
#[derive(Debug)]
struct PartsOnDisk {
    cache: Cache,
    key: RecordKey,
}

impl PartsOnDisk {
    fn file(&self, tooth: u32) -> PathBuf {
        self.named(format!("{}-{tooth}.{COLUMNS_SUFFIX}", self.key))
    }

    fn factor_file(&self) -> PathBuf {
        self.named(format!("{}.{FACTOR_SUFFIX}", self.key))
    }

    fn table_file(&self, table: &TableKey) -> PathBuf {
        self.named(format!("{}-{table}.{TABLE_SUFFIX}", self.key))
    }

    fn named(&self, name: String) -> PathBuf {
        self.cache.folder.as_deref().unwrap_or(Path::new("")).join(name)
    }

    fn write_part(&self, file: &Path, bytes: &[u8]) -> Result<(), PartFault> {
        let written = self.cache.write(file, bytes);
        written.map_err(|e| PartFault { file: file.display().to_string(), what: e.to_string(), writing: true })
    }
}

impl PartStore for PartsOnDisk {
    fn load(&self, tooth: u32) -> Result<Option<ToothColumns>, PartFault> {
        read_part(&self.file(tooth), |from, length| ToothColumns::read(from, length, &self.key))
    }

    fn save(&self, columns: &ToothColumns) -> Result<(), PartFault> {
        self.write_part(&self.file(columns.tooth), &columns.to_bytes(&self.key))
    }

    fn load_factor(&self) -> Result<Option<KeptFactor>, PartFault> {
        read_part(&self.factor_file(), |from, length| read_factor(from, length, &self.key))
    }

    fn save_factor(&self, factor: &KeptFactor) -> Result<(), PartFault> {
        self.write_part(&self.factor_file(), &factor_bytes(factor, &self.key))
    }

    fn load_table(&self, table: &TableKey) -> Result<Option<Vec<f64>>, PartFault> {
        read_part(&self.table_file(table), |from, length| read_table(table, from, length, &self.key))
    }

    fn save_table(&self, table: &TableKey, values: &[f64]) -> Result<(), PartFault> {
        self.write_part(&self.table_file(table), &table_bytes(table, values, &self.key))
    }
}

/// What a file has, if it is there.
fn read_part<T>(file: &Path, read: impl FnOnce(File, usize) -> Result<T, RecordError>) -> Result<Option<T>, PartFault> {
    let fault = |what: String| PartFault { file: file.display().to_string(), what, writing: false };
    let (from, length) = match open_regular_file(file, most::RECORD) {
        Ok(opened) => opened,
        Err(e) if e.kind() == ErrorKind::NotFound => return Ok(None),
        Err(e) => return Err(fault(e.to_string())),
    };
    let found = read(from, length as usize).map_err(|e| fault(e.to_string()))?;
    touch(file);
    Ok(Some(found))
}

/// What a file says of a sound mesh.
fn sound_text(key: &SoundKey) -> String {
    format!("{SOUND_HEADING} {SOUND_VERSION}\n{key}\n")
}

/// Maps as JSON, which keeps every digit, after three lines: what it is and of which version, the key, and BLAKE3 of the
/// key and the JSON.
fn map_bytes(key: &MapKey, maps: &[&ContactMap]) -> Result<Vec<u8>, serde_json::Error> {
    let text = serde_json::to_string(maps)?;
    Ok(format!("{MAP_HEADING} {MAP_VERSION}\n{key}\n{}\n{text}", map_digest(&key.to_string(), &text)).into_bytes())
}

fn map_digest(key: &str, text: &str) -> String {
    let mut hasher = blake3::Hasher::new();
    hasher.update(key.as_bytes()).update(text.as_bytes());
    hasher.finalize().to_hex().to_string()
}

/// The maps of a key that [`map_bytes`] wrote; else what is wrong.
fn maps_from(bytes: &[u8], key: &MapKey) -> Result<Vec<ContactMap>, &'static str> {
    const NO_MAPS: &str = "is not a file of maps of this version";
    let text = std::str::from_utf8(bytes).map_err(|_| NO_MAPS)?;
    let (heading, rest) = text.split_once('\n').ok_or(NO_MAPS)?;
    if heading != format!("{MAP_HEADING} {MAP_VERSION}") {
        return Err(NO_MAPS);
    }
    let lines = rest.split_once('\n').and_then(|(own, rest)| Some((own, rest.split_once('\n')?)));
    let (own, (digest, text)) = lines.ok_or("is damaged: it has no maps")?;
    if map_digest(own, text) != digest {
        return Err("is damaged: its checksum is wrong");
    }
    if own != key.to_string() {
        return Err("belongs to another contact");
    }
    serde_json::from_str(text).map_err(|_| "is damaged: it has no maps")
}

/// Marks a file as used now. Where the system does not let it, the file is only taken for older than it is.
fn touch(file: &Path) {
    let _ = File::options().append(true).open(file).and_then(|f| f.set_modified(SystemTime::now()));
}

/// Whether a name is one that this program gives: a key and what the file holds.
fn is_record(path: &Path) -> bool {
    let suffix = path.extension().and_then(|e| e.to_str());
    let stem = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
    let is_key = |key: &str| key.len() == 64 && key.bytes().all(|b| b.is_ascii_digit() || (b'a'..=b'f').contains(&b));
    let (key, known) = match stem.split_once('-') {
        Some((key, part)) if suffix == Some(TABLE_SUFFIX) => (key, is_key(part)),
        Some((key, tooth)) => (key, suffix == Some(COLUMNS_SUFFIX) && tooth.parse::<u32>().is_ok()),
        None => (stem, suffix.is_some_and(|e| [SUFFIX, FACTOR_SUFFIX, MAP_SUFFIX, SOUND_SUFFIX].contains(&e))),
    };
    known && is_key(key)
}

/// Removes the least recently used files until the rest is within the limit; `newest` stays.
fn make_room(folder: &Path, newest: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    let mut files: Vec<(SystemTime, u64, PathBuf)> = entries
        .filter_map(|entry| {
            let path = entry.ok()?.path();
            let data = fs::symlink_metadata(&path).ok()?;
            let ours = is_record(&path) && data.is_file() && path != newest;
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
