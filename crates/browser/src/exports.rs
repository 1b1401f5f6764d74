//! What a page calls.
#![allow(unsafe_code)] // names that JavaScript finds, and a function that it gives

use std::cell::RefCell;

#[link(wasm_import_module = "page")]
unsafe extern "C" {
    /// Time since some moment, ms.
    pub(crate) safe fn clock_ms() -> f64;
}

thread_local! {
    static MOVE: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static ANSWER: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// Makes room for a move of so many bytes; its address.
#[unsafe(no_mangle)]
extern "C" fn room(bytes: usize) -> *mut u8 {
    MOVE.with_borrow_mut(|all| {
        *all = vec![0; bytes];
        all.as_mut_ptr()
    })
}

/// Answers the move that was written there; bytes of the answer.
#[unsafe(no_mangle)]
extern "C" fn answer() -> usize {
    let answered = MOVE.with_borrow(|all| crate::answer(all));
    ANSWER.replace(answered);
    ANSWER.with_borrow(Vec::len)
}

/// Address of the answer, until the next move.
#[unsafe(no_mangle)]
extern "C" fn answered() -> *const u8 {
    ANSWER.with_borrow(Vec::as_ptr)
}
