//! An allocator that ends the program at too much memory, as a reader should never ask for.
#![allow(unsafe_code, reason = "an allocator is")]

use std::{
    alloc::{GlobalAlloc, Layout, System, handle_alloc_error},
    sync::atomic::{AtomicUsize, Ordering::Relaxed},
};

/// What may be taken at once and in all, bytes.
pub const MOST: usize = 1 << 30;

/// The system's allocator up to [`MOST`]; what asks for more aborts, with the size in the message.
pub struct Limited {
    taken: AtomicUsize,
    peak: AtomicUsize,
}

impl Limited {
    /// Nothing taken yet.
    pub const fn new() -> Self {
        Self { taken: AtomicUsize::new(0), peak: AtomicUsize::new(0) }
    }

    /// The most that was taken since the last call, bytes.
    pub fn peak(&self) -> usize {
        self.peak.swap(self.taken.load(Relaxed), Relaxed)
    }

    fn add(&self, layout: Layout, more: usize) {
        let taken = self.taken.fetch_add(more, Relaxed) + more;
        self.peak.fetch_max(taken, Relaxed);
        if taken > MOST {
            handle_alloc_error(layout);
        }
    }
}

impl Default for Limited {
    fn default() -> Self {
        Self::new()
    }
}

unsafe impl GlobalAlloc for Limited {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        self.add(layout, layout.size());
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        self.add(layout, layout.size());
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        self.taken.fetch_sub(layout.size(), Relaxed);
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        self.add(layout, size);
        self.taken.fetch_sub(layout.size(), Relaxed);
        unsafe { System.realloc(pointer, layout, size) }
    }
}
