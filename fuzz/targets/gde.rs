#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::watched(verification::readers::gde, bytes));
