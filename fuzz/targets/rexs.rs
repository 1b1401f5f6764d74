#![no_main]

#[global_allocator]
static LIMITED: verification::readers::limited::Limited = verification::readers::limited::Limited::new();

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| verification::readers::rexs(bytes));
