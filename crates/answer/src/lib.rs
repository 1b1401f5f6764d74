//! What is an answer made of, whatever was asked?
//!
//! An [`Answer`] holds tables of rows, a headline, checks, remarks, and facts about the run. Solvers make it, and everything
//! that shows results reads it: files, pages, closing tables, Python.
//!
//! | module | what it does |
//! |---|---|
//! | [`Table`], [`Column`] | columns of numbers or texts; name, unit and meaning stand once |
//! | [`unit_of`], [`shown_units`] | the unit that a name ends with, and units as people read them |
//! | [`label_of`] | a key in words, for titles and axes |
//! | [`csv`] | numbers and texts as fields of a file with commas |
//! | [`write_table`], [`write_parquet`] | the files of a table |
//! | [`RowStore`], [`RowColumn`] | rows of a motion in constant memory, and columns of a table that are read off them |
//! | [`Check`], [`Checks`] | what was demanded of a result and what was found |
//! | [`Remark`], [`remarks!`] | what a user should hear: code, values, and the words made of them |
//! | [`Numbers`] | numbers with so many digits, for the script of a page |
//! | [`Cost`], [`Phase`] | time and memory of a run |
//! | [`Answer`] | all of it together |
//! | [`keyed`] | an object as its keys with their values |
//! | [`leaves`] | the values of a tree of JSON with their paths |

mod answer;
mod check;
mod columnar;
mod cost;
pub mod csv;
mod error;
mod label;
mod leaves;
mod numbers;
mod remark;
mod row_column;
mod row_store;
mod table;
mod table_files;
mod unit;

pub use answer::{Answer, keyed};
pub use check::{Check, Checks, FailedCheck};
pub use cost::{Cost, Phase};
pub use error::TableError;
pub use label::label_of;
pub use leaves::leaves;
pub use numbers::{Numbers, json};
pub use remark::{Remark, RemarkKind, RemarkValue, digits};
pub use row_column::{KeptColumn, OfRow, RowColumn};
pub use row_store::RowStore;
pub use table::{Column, Table, Values};
pub use table_files::{TakeLines, write_parquet, write_table};
pub use unit::{shown_units, unit_of};
