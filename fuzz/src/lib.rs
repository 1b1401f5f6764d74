//! What every target has: memory that is bounded and counted, and a word about the slowest and the largest input.

use std::{
    sync::atomic::{AtomicU64, Ordering::Relaxed},
    time::Instant,
};

use verification::readers::{Reader, limited::Limited};

#[global_allocator]
static MEMORY: Limited = Limited::new();

/// Most memory and longest time of one input so far.
static BYTES: AtomicU64 = AtomicU64::new(0);
static MICROSECONDS: AtomicU64 = AtomicU64::new(0);

/// Reads an input. Where it took a hundredth more memory or time than all before it, a line says so; `fuzz/run` reads
/// the last of each kind.
pub fn watched(reader: Reader, bytes: &[u8]) {
    // What the reader before it left is not this one's.
    MEMORY.peak();
    let start = Instant::now();
    reader(bytes);
    tell("time", &MICROSECONDS, start.elapsed().as_micros() as u64, "us");
    tell("memory", &BYTES, MEMORY.peak() as u64, "bytes");
}

fn tell(what: &str, so_far: &AtomicU64, now: u64, unit: &str) {
    if now > so_far.load(Relaxed) / 100 * 101 {
        so_far.store(now, Relaxed);
        eprintln!("most {what} of one input: {now} {unit}");
    }
}
