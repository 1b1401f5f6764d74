//! The page over its protocol: who is answered, and with which numbers.

mod answers;
mod attacks;
mod guarding;
mod served;
