//! A scene that is being drawn: chance, keys with their values, and the files that it names.

use scene::Value;
use testing::Random;
use toml::Table;

/// Keys of a scene and the sequence of chance that they come from.
#[derive(Debug)]
pub struct Draft {
    random: Random,
    table: Table,
    /// Name and content of files beside the scene.
    pub files: Vec<(String, String)>,
}

impl Draft {
    /// The empty scene number `index` of a seed; neighbours are far apart.
    pub fn new(seed: u64, index: u64) -> Self {
        let start = seed.wrapping_mul(0x5851_f42d_4c95_7f2d) ^ index.wrapping_mul(0xd134_2543_de82_ef95);
        Self { random: Random::new(start), table: Table::new(), files: Vec::new() }
    }

    /// Sets a key with dots before it; a number among its parts counts the entries of a list of tables.
    pub fn set(&mut self, key: &str, value: impl Into<Value>) {
        let parts: Vec<&str> = key.split('.').collect();
        put(&mut self.table, &parts, value.into());
    }

    /// What stands behind a key.
    pub fn get(&self, key: &str) -> Option<&Value> {
        let mut parts = key.split('.');
        let mut at = self.table.get(parts.next()?)?;
        for part in parts {
            at = match at {
                Value::Array(list) => list.get(part.parse::<usize>().ok()?)?,
                other => other.get(part)?,
            };
        }
        Some(at)
    }

    /// A number behind a key.
    pub fn number(&self, key: &str) -> Option<f64> {
        let value = self.get(key)?;
        value.as_float().or(value.as_integer().map(|i| i as f64))
    }

    /// Takes a key or a table away.
    pub fn unset(&mut self, key: &str) {
        match key.rsplit_once('.') {
            None => drop(self.table.remove(key)),
            Some((table, last)) => {
                let mut at = Some(&mut self.table);
                let mut parts = table.split('.').peekable();
                while let Some(part) = parts.next() {
                    let inner = at.and_then(|t| t.get_mut(part));
                    at = match (inner, parts.peek().and_then(|number| number.parse::<usize>().ok())) {
                        (Some(Value::Array(list)), Some(number)) => {
                            parts.next();
                            list.get_mut(number).and_then(Value::as_table_mut)
                        }
                        (inner, _) => inner.and_then(Value::as_table_mut),
                    };
                }
                at.map(|t| t.remove(last));
            }
        }
    }

    /// Takes all keys of a table over.
    pub fn put_all(&mut self, table: Table) {
        self.table = table;
    }

    /// The key with every first entry of a list of tables replaced by any of those that are there, or the one after.
    pub fn at_some_entry(&mut self, key: &str) -> String {
        let mut found = String::new();
        for part in key.split('.') {
            let part = if part == "0" {
                let there = self.get(&found).and_then(Value::as_array).map_or(0, Vec::len) as u32;
                // Rarely one more.
                let last = if self.chance(0.1) { there } else { there.saturating_sub(1) };
                self.whole(0, last).to_string()
            } else {
                part.to_owned()
            };
            found = if found.is_empty() { part } else { format!("{found}.{part}") };
        }
        found
    }

    /// The name of any entry of a list of tables.
    pub fn name_of(&mut self, list: &str) -> Option<Value> {
        let names: Vec<Value> =
            self.get(list)?.as_array()?.iter().filter_map(|entry| entry.get("name").cloned()).collect();
        let at = self.whole(0, names.len().checked_sub(1)? as u32) as usize;
        names.get(at).cloned()
    }

    /// Whole paths of all keys that are set, the entries of lists of tables counted.
    pub fn paths(&self) -> Vec<String> {
        let mut all = Vec::new();
        paths("", &self.table, &mut all);
        all
    }

    /// All numbers behind keys whose last part is this one.
    pub fn numbers(&self, last: &str) -> Vec<f64> {
        let mut all = Vec::new();
        numbers(&self.table, last, &mut all);
        all
    }

    /// Whether something of this share happens.
    pub fn chance(&mut self, share: f64) -> bool {
        self.between(0.0, 1.0) < share
    }

    /// A number, each alike.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.random.between(low, high)
    }

    /// A number, each order of magnitude alike.
    pub fn log(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp().clamp(low, high)
    }

    /// Near the usual most of the time, else anywhere in the whole range.
    pub fn mostly(&mut self, usual: [f64; 2], all: [f64; 2]) -> f64 {
        if self.chance(0.85) { self.between(usual[0], usual[1]) } else { self.between(all[0], all[1]) }
    }

    /// A value that is mostly within a usual range, drawn by its order of magnitude.
    pub fn mostly_log(&mut self, usual: [f64; 2], all: [f64; 2]) -> f64 {
        if self.chance(0.85) { self.log(usual[0], usual[1]) } else { self.log(all[0], all[1]) }
    }

    /// A whole number, both ends included.
    pub fn whole(&mut self, low: u32, high: u32) -> u32 {
        (self.between(f64::from(low), f64::from(high) + 1.0) as u32).min(high)
    }

    /// One of some.
    pub fn pick<T: Copy>(&mut self, of: &[T]) -> T {
        of[(self.between(0.0, of.len() as f64) as usize).min(of.len() - 1)]
    }

    /// Some of some, in their order; may be none.
    pub fn some_of(&mut self, of: &[&str]) -> Vec<Value> {
        of.iter().filter(|_| self.chance(0.5)).map(|word| Value::from(*word)).collect()
    }

    /// Rows of numbers.
    pub fn set_rows(&mut self, key: &str, rows: Vec<Vec<f64>>) {
        self.set(key, rows.into_iter().map(Value::from).collect::<Vec<_>>());
    }

    /// A draft with the same keys and files; chance goes on from another place.
    pub fn copy(&self) -> Self {
        Self { random: Random::new(0), table: self.table.clone(), files: self.files.clone() }
    }

    /// A draft of these keys, without files.
    pub fn of_table(table: Table) -> Self {
        Self { random: Random::new(0), table, files: Vec::new() }
    }

    /// The scene file.
    ///
    /// # Errors
    /// What TOML cannot say, which no draw makes.
    pub fn text(&self) -> Result<String, toml::ser::Error> {
        toml::to_string(&self.table)
    }

    /// Keys that are set, as [`scene::all_keys`] writes them: the first entry of a list stands for all.
    pub fn keys(&self) -> Vec<String> {
        let mut all = Vec::new();
        walk("", &self.table, &mut all);
        all
    }
}

fn paths(path: &str, table: &Table, all: &mut Vec<String>) {
    for (key, value) in table {
        let key = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
        match value {
            Value::Table(inner) => paths(&key, inner, all),
            Value::Array(list) if list.iter().any(Value::is_table) => {
                for (number, inner) in list.iter().filter_map(Value::as_table).enumerate() {
                    paths(&format!("{key}.{number}"), inner, all);
                }
            }
            _ => all.push(key),
        }
    }
}

fn numbers(table: &Table, last: &str, all: &mut Vec<f64>) {
    for (key, value) in table {
        if key == last {
            of_value(value, all);
        }
        match value {
            Value::Table(inner) => numbers(inner, last, all),
            Value::Array(list) => list.iter().filter_map(Value::as_table).for_each(|inner| numbers(inner, last, all)),
            _ => {}
        }
    }
}

/// The number that a value is, or all numbers of a list of them.
fn of_value(value: &Value, all: &mut Vec<f64>) {
    match value {
        Value::Array(list) => list.iter().for_each(|inner| of_value(inner, all)),
        other => all.extend(other.as_float().or(other.as_integer().map(|i| i as f64))),
    }
}

fn put(table: &mut Table, parts: &[&str], value: Value) {
    let [first, rest @ ..] = parts else { return };
    match rest {
        [] => drop(table.insert((*first).to_owned(), value)),
        [number, inner @ ..] if number.parse::<usize>().is_ok() => {
            let list = table.entry(*first).or_insert_with(|| Value::Array(Vec::new()));
            let (Value::Array(list), Ok(index)) = (list, number.parse::<usize>()) else { return };
            while list.len() <= index {
                list.push(Value::Table(Table::new()));
            }
            if let Value::Table(entry) = &mut list[index] {
                put(entry, inner, value);
            }
        }
        _ => {
            let inner = table.entry(*first).or_insert_with(|| Value::Table(Table::new()));
            if let Value::Table(inner) = inner {
                put(inner, rest, value);
            }
        }
    }
}

fn walk(path: &str, table: &Table, all: &mut Vec<String>) {
    for (key, value) in table {
        let key = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
        match value {
            Value::Table(inner) => walk(&key, inner, all),
            Value::Array(list) if list.iter().any(Value::is_table) => {
                list.iter().filter_map(Value::as_table).for_each(|t| walk(&format!("{key}.0"), t, all));
            }
            _ => all.push(key),
        }
    }
}
