//! What does the gear look like from its flanks?
