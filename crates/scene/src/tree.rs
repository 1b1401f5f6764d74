//! The tables and values of a document with their places: parsed from its text once, changed by settings, read by
//! serde.

use std::{borrow::Cow, collections::BTreeMap, fmt, ops::Range};

use serde::{
    Deserializer,
    de::{self, DeserializeSeed, IntoDeserializer, MapAccess, Visitor, value::SeqDeserializer},
    forward_to_deserialize_any,
};
use serde_spanned::de::{SpannedDeserializer, is_spanned};
use toml::{
    Spanned,
    de::{DeTable, DeValue},
};

/// The key behind which another document is named, or stands itself.
const DOCUMENT: &str = "scene";

/// A value and the bytes of the text that it stands in.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Node {
    pub span: Range<usize>,
    pub value: Value,
}

/// Tables and values; unlike those of `toml`, they borrow nothing of the text.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Value {
    Text(String),
    Whole(i128),
    Number(f64),
    Switch(bool),
    /// A date or a time, which no key takes.
    Date,
    /// A number beyond every type, with what is said of it.
    Overflow(&'static str),
    List(Vec<Node>),
    Table(BTreeMap<String, Entry>),
}

/// What stands behind a key.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Entry {
    /// Where the key stands.
    pub key: Range<usize>,
    pub node: Node,
}

/// What is wrong with a text, or with the type of a value in it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Fault {
    pub message: String,
    pub span: Option<Range<usize>>,
}

impl Fault {
    fn at(self, span: &Range<usize>) -> Self {
        Self { span: self.span.or_else(|| Some(span.clone())), ..self }
    }
}

impl From<toml::de::Error> for Fault {
    fn from(error: toml::de::Error) -> Self {
        Self { message: error.message().to_owned(), span: error.span() }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Fault {}

impl de::Error for Fault {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self { message: message.to_string(), span: None }
    }
}

impl Node {
    /// The tables of a text.
    ///
    /// # Errors
    /// The error of the TOML parser.
    pub fn of_text(text: &str) -> Result<Self, Fault> {
        let root = DeTable::parse(text)?;
        Ok(Self { span: root.span(), value: table(root.get_ref()) })
    }

    /// One value; places refer to its own text.
    ///
    /// # Errors
    /// The error of the TOML parser.
    pub fn of_value(text: &str) -> Result<Self, Fault> {
        Ok(node(&DeValue::parse(text)?))
    }

    /// The entries of a table; empty for other nodes.
    pub fn entries(&self) -> impl Iterator<Item = (&String, &Entry)> {
        let table = if let Value::Table(table) = &self.value { Some(table) } else { None };
        table.into_iter().flatten()
    }

    /// The number at a path, as [`Node::put`] interprets it.
    pub fn number_at(&self, path: &[String]) -> Option<f64> {
        match (&self.value, path.split_first()) {
            (Value::Whole(own), None) => Some(*own as f64),
            (Value::Number(own), None) => Some(*own),
            (Value::Table(table), Some((first, rest))) => table.get(first)?.node.number_at(rest),
            (Value::List(list), Some((first, rest))) => list[entry_of(list, first)?].number_at(rest),
            _ => None,
        }
    }

    /// Message for a path that names a missing entry of a list whose other entries have names.
    pub fn nobody_called(&self, path: &[String]) -> Option<String> {
        let (first, rest) = path.split_first()?;
        match &self.value {
            Value::Table(table) => table.get(first)?.node.nobody_called(rest),
            Value::List(list) => match entry_of(list, first) {
                Some(i) => list[i].nobody_called(rest),
                // The next number begins a new entry.
                None if first.parse::<usize>().is_ok_and(|i| i <= list.len()) => None,
                None if first.parse::<usize>().is_ok() => Some(format!(
                    "there is no entry {first}: entries are numbered from 0, and there are {}",
                    list.len()
                )),
                None => {
                    let names: Vec<String> = list.iter().enumerate().filter_map(|(i, own)| own.named(i)).collect();
                    (!names.is_empty()).then(|| format!("none is called `{first}`; there are {}", names.join(", ")))
                }
            },
            _ => None,
        }
    }

    /// Number and name of an entry of a list that has one.
    fn named(&self, number: usize) -> Option<String> {
        self.entries().find_map(|(key, entry)| match &entry.node.value {
            Value::Text(name) if key == "name" => Some(format!("{number} (\"{name}\")")),
            _ => None,
        })
    }

    /// The subdocument at a place: the table of a key that may also be a path.
    pub fn part(&self, span: &Range<usize>) -> Option<&Self> {
        match &self.value {
            Value::List(list) => list.iter().find_map(|own| own.part(span)),
            Value::Table(table) => table.iter().find_map(|(key, own)| {
                let is_it = key == DOCUMENT && own.node.span == *span && matches!(own.node.value, Value::Table(_));
                if is_it { Some(&own.node) } else { own.node.part(span) }
            }),
            _ => None,
        }
    }

    /// Whether it is this text.
    fn is_text(&self, text: &str) -> bool {
        matches!(&self.value, Value::Text(own) if own == text)
    }

    /// This node with only the entries of its table that `keeps` selects.
    pub fn only(self, keeps: impl Fn(&str) -> bool) -> Self {
        let value = match self.value {
            Value::Table(table) => Value::Table(table.into_iter().filter(|(name, _)| keeps(name)).collect()),
            other => other,
        };
        Self { value, ..self }
    }

    /// This node with all places moved by an offset.
    pub fn moved(&self, by: usize) -> Self {
        let moved = |span: &Range<usize>| span.start + by..span.end + by;
        let value = match &self.value {
            Value::List(list) => Value::List(list.iter().map(|own| own.moved(by)).collect()),
            Value::Table(table) => Value::Table(
                table
                    .iter()
                    .map(|(key, own)| (key.clone(), Entry { key: moved(&own.key), node: own.node.moved(by) }))
                    .collect(),
            ),
            other => other.clone(),
        };
        Self { span: moved(&self.span), value }
    }

    /// Puts a value at a path and makes tables on the way. In a list a number is the index of an entry, and another
    /// word is the `name` of one. An entry that is neither becomes a table, so that the type error names the value's
    /// place.
    pub fn put(&mut self, path: &[String], value: Self) {
        let Some((first, rest)) = path.split_first() else {
            *self = value;
            return;
        };
        match &mut self.value {
            Value::Table(table) => match table.get_mut(first) {
                Some(there) => there.node.put(rest, value),
                None => {
                    let key = value.span.clone();
                    table.insert(first.clone(), Entry { key, node: value.below(rest) });
                }
            },
            Value::List(list) => match entry_of(list, first) {
                Some(i) => list[i].put(rest, value),
                None if first.parse() == Ok(list.len()) => list.push(value.below(rest)),
                None => *self = value.below(path),
            },
            _ => *self = value.below(path),
        }
    }

    /// A value below the keys of `path` alone.
    fn below(self, path: &[String]) -> Self {
        path.iter().rev().fold(self, |node, key| {
            let span = node.span.clone();
            if key == "0" {
                // The first entry of a list that is not there yet.
                return Self { span, value: Value::List(vec![node]) };
            }
            let entry = Entry { key: span.clone(), node };
            Self { span, value: Value::Table(BTreeMap::from([(key.clone(), entry)])) }
        })
    }
}

/// The entry of a list that a part of a key means: by its number from 0, else by its `name`.
fn entry_of(list: &[Node], which: &str) -> Option<usize> {
    let is_named = |own: &Node| own.entries().any(|(key, entry)| key == "name" && entry.node.is_text(which));
    which.parse().ok().filter(|i| *i < list.len()).or_else(|| list.iter().position(is_named))
}

fn node(value: &Spanned<DeValue<'_>>) -> Node {
    let digits = |own: &str, radix| i128::from_str_radix(own, radix).ok();
    let made = match value.get_ref() {
        DeValue::String(text) => Value::Text(text.clone().into_owned()),
        DeValue::Integer(own) => {
            digits(own.as_str(), own.radix()).map_or(Value::Overflow("integer number overflowed"), Value::Whole)
        }
        DeValue::Float(own) => match own.as_str().parse::<f64>() {
            Ok(x) if x.is_finite() || x.is_nan() || own.as_str().contains("inf") => Value::Number(x),
            _ => Value::Overflow("floating-point number overflowed"),
        },
        DeValue::Boolean(on) => Value::Switch(*on),
        DeValue::Datetime(_) => Value::Date,
        DeValue::Array(list) => Value::List(list.iter().map(node).collect()),
        DeValue::Table(own) => table(own),
    };
    Node { span: value.span(), value: made }
}

fn table(own: &DeTable<'_>) -> Value {
    let entry = |(key, value): (&Spanned<Cow<'_, str>>, &Spanned<DeValue<'_>>)| {
        (key.get_ref().clone().into_owned(), Entry { key: key.span(), node: node(value) })
    };
    Value::Table(own.iter().map(entry).collect())
}

impl<'de> IntoDeserializer<'de, Fault> for &'de Node {
    type Deserializer = Self;

    fn into_deserializer(self) -> Self {
        self
    }
}

impl<'de> Deserializer<'de> for &'de Node {
    type Error = Fault;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        match &self.value {
            Value::Text(text) => visitor.visit_borrowed_str(text),
            Value::Whole(own) => match (i64::try_from(*own), u64::try_from(*own)) {
                (Ok(own), _) => visitor.visit_i64(own),
                (_, Ok(own)) => visitor.visit_u64(own),
                _ => visitor.visit_i128(*own),
            },
            Value::Number(own) => visitor.visit_f64(*own),
            Value::Switch(on) => visitor.visit_bool(*on),
            Value::Date => visitor.visit_map(Entries { left: None, value: None }),
            Value::Overflow(said) => Err(de::Error::custom(said)),
            Value::List(list) => visitor.visit_seq(SeqDeserializer::new(list.iter())),
            Value::Table(table) => visitor.visit_map(Entries { left: Some(table.iter()), value: None }),
        }
        .map_err(|fault| fault.at(&self.span))
    }

    // What is written is there: a key that is not there has no node.
    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_some(self)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(self, _: &'static str, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        if is_spanned(name) {
            return visitor.visit_map(SpannedDeserializer::new(self, self.span.clone()));
        }
        self.deserialize_any(visitor)
    }

    forward_to_deserialize_any! {
        bool u8 u16 u32 u64 i8 i16 i32 i64 i128 u128 f32 f64 char str string seq bytes byte_buf map unit ignored_any
        unit_struct tuple_struct tuple identifier enum
    }
}

/// The entries of a table that serde has not seen yet.
struct Entries<'de> {
    left: Option<std::collections::btree_map::Iter<'de, String, Entry>>,
    value: Option<&'de Node>,
}

impl<'de> MapAccess<'de> for Entries<'de> {
    type Error = Fault;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, Fault> {
        let Some((key, entry)) = self.left.as_mut().and_then(Iterator::next) else { return Ok(None) };
        self.value = Some(&entry.node);
        let key: de::value::BorrowedStrDeserializer<'de, Fault> = de::value::BorrowedStrDeserializer::new(key);
        seed.deserialize(key).map(Some).map_err(|fault| fault.at(&entry.key))
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, Fault> {
        match self.value.take() {
            Some(node) => seed.deserialize(node).map_err(|fault| fault.at(&node.span)),
            None => Err(de::Error::custom("a value without its key")),
        }
    }
}

#[cfg(test)]
mod tests {
    use serde::Deserialize;

    use super::*;

    #[derive(Debug, Deserialize, PartialEq)]
    #[serde(deny_unknown_fields)]
    struct Read {
        a: Option<Spanned<f64>>,
        b: Option<Vec<Spanned<i64>>>,
        c: Option<Spanned<Inner>>,
    }

    #[derive(Debug, Deserialize, PartialEq)]
    #[serde(deny_unknown_fields)]
    struct Inner {
        d: Option<String>,
    }

    /// Values, places and complaints are those of the TOML reader.
    #[test]
    fn a_tree_reads_as_its_text_does() {
        for text in [
            "",
            "a = 3\n[c]\nd = \"x\"\n",
            "a = 1_000.5e-3\nb = [1, 0x10]\nc = { d = 'y' }\n",
            "a = \"x\"",
            "a = 1979-05-27",
            "b = [1, 2.5]",
            "b = 3",
            "b = 99999999999999999999999999999999999999999999",
            "a = 1e999",
            "a = inf",
            "b = [18446744073709551615]",
            "c = 3",
            "c.d = true",
            "c.e = 3",
            "z = 3\ny = 4\n",
            "[[c]]\nd = 'x'\n",
        ] {
            let own = Node::of_text(text).and_then(|root| Read::deserialize(&root));
            let by_toml = toml::from_str::<Read>(text).map_err(Fault::from);
            assert_eq!(own, by_toml, "{text}");
        }
    }

    /// A value that is set stands where the key has it, at its own place; the rest stays.
    #[test]
    fn what_is_set_takes_its_place() {
        let path = |key: &str| key.split('.').map(str::to_owned).collect::<Vec<_>>();
        let set = |text: &str, key: &str, value: &str| {
            let mut root = Node::of_text(text).unwrap();
            root.put(&path(key), Node::of_value(value).unwrap().moved(100));
            Read::deserialize(&root)
        };
        let read = set("a = 1\n[c]\nd = \"x\"\n", "a", "2").unwrap();
        assert_eq!(read.a, Some(Spanned::new(100..101, 2.0)));
        assert_eq!(read.a.unwrap().span(), 100..101);
        assert_eq!(set("", "c.d", "\"y\"").unwrap().c.unwrap().get_ref().d.as_deref(), Some("y"));
        assert_eq!(set("b = [1, 2]", "b.1", "7").unwrap().b.unwrap()[1].span(), 100..101);
        assert_eq!(set("b = [1, 2]", "b.2", "7").unwrap().b.unwrap()[2].span(), 100..101, "one more entry");
        assert_eq!(set("", "b.0", "7").unwrap().b.unwrap().len(), 1, "the first one");
        let beyond = set("b = [1, 2]", "b.3", "7").unwrap_err();
        assert_eq!((beyond.span, beyond.message.starts_with("invalid type: map")), (Some(100..101), true));
        let named = |which: &str| {
            let mut root = Node::of_text("[[g]]\nname = \"x\"\n[[g]]\nname = \"y, z\"\n").unwrap();
            root.put(
                &path("g").into_iter().chain([which.to_owned(), "at".to_owned()]).collect::<Vec<_>>(),
                Node::of_value("5").unwrap(),
            );
            let Value::List(list) = &root.entries().next().unwrap().1.node.value else { panic!("no list") };
            list.iter().position(|own| own.entries().any(|(key, _)| key == "at"))
        };
        assert_eq!(["x", "y, z", "1"].map(named), [Some(0), Some(1), Some(1)]);
        let within = set("a = 1", "a.x", "7").unwrap_err();
        assert_eq!((within.span, within.message.starts_with("invalid type: map")), (Some(100..101), true));
    }
}
