//! The deck of one position.

use crate::calculix_pair::{PAIRS, pair};
use geometry::Side;
use mesh::MeshedGear;
use study::calculix::{Calculix, CalculixError, Deck};

/// Lines of every block of the deck that begins with `keyword`, up to the next keyword.
fn block_lines(text: &str, keyword: &str) -> usize {
    let mut inside = false;
    text.lines()
        .filter(|l| {
            let is_keyword = l.starts_with('*');
            if is_keyword {
                inside = l.starts_with(keyword);
            }
            inside && !is_keyword
        })
        .count()
}

#[test]
fn a_deck_has_every_node_element_and_face() {
    for order in [1, 2] {
        let model = pair(order);
        let text = model.deck().text().unwrap();
        let sum = |count: fn(&MeshedGear) -> usize| model.gears.iter().map(count).sum::<usize>();
        let nodes = sum(|g| g.mesh().nodes.len());
        // Two more for the rigid bore and its rotation.
        assert_eq!(block_lines(&text, "*NODE, NSET="), nodes + 2, "order {order}");
        let lines = if order == 1 { 1 } else { 2 };
        assert_eq!(block_lines(&text, "*ELEMENT"), lines * sum(|g| g.mesh().element_count()), "order {order}");
        let faces: usize = (0..2)
            .flat_map(|i| PAIRS.iter().map(move |teeth| (i, teeth[i])))
            .map(|(i, tooth)| model.gears[i].flank(tooth, Side::Left).unwrap().len())
            .sum();
        assert_eq!(block_lines(&text, "*SURFACE, NAME"), faces, "order {order}");
        assert_eq!(block_lines(&text, "*NSET, NSET=bore"), sum(|g| g.bore_nodes().len()));
        let long = text.lines().flat_map(|l| l.split(',')).map(|word| word.trim().len()).max();
        assert!(long <= Some(60), "a word of {long:?} characters");
    }
}

#[test]
fn a_deck_without_sense_is_refused() {
    let model = pair(1);
    let deck = model.deck();
    for wrong in [f64::NAN, 0.0, -1.0, f64::INFINITY] {
        for deck in [Deck { torque: wrong, ..deck }, Deck { closing: wrong, ..deck }, Deck { penalty: wrong, ..deck }] {
            assert!(matches!(deck.text(), Err(CalculixError::OutOfRange { .. })), "{wrong}");
        }
    }
    let missing = Deck { pairs: &[[15, 0]], ..deck };
    assert!(matches!(missing.text(), Err(CalculixError::MissingFlank { gear: "pinion", tooth: 15, .. })));
    assert!(matches!(Calculix::at("no/such/program".as_ref(), 1), Err(CalculixError::NotInstalled { .. })));
}
