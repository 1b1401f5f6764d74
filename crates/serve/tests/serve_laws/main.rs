//! The page over its protocol: who is answered, and with which numbers.

mod answers;
mod guarding;
mod served;
