//! The state's own digest around it, so that no changed byte is taken for a state.

/// Before the digest, BLAKE3 of the bytes of the state; between both; behind the state.
const BEFORE_DIGEST: &str = "{\"blake3\":\"";
const BEFORE_STATE: &str = "\",\"state\":";
const AFTER_STATE: &str = "}\n";

/// The text of the file of a state (JSON): itself, with its digest before it.
pub fn sealed_state(state: &str) -> String {
    let digest = blake3::hash(state.as_bytes()).to_hex();
    format!("{BEFORE_DIGEST}{digest}{BEFORE_STATE}{state}{AFTER_STATE}")
}

/// The state in a file's text, if the digest before it is its own.
pub(super) fn unsealed(text: &str) -> Option<&str> {
    let (digest, rest) = text.strip_prefix(BEFORE_DIGEST)?.split_once(BEFORE_STATE)?;
    let state = rest.strip_suffix(AFTER_STATE)?;
    (blake3::hash(state.as_bytes()).to_hex().as_str() == digest).then_some(state)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_changed_byte_is_no_state() {
        let text = sealed_state("{\"a\":1}");
        assert_eq!(unsealed(&text), Some("{\"a\":1}"));
        assert_eq!(unsealed(&text.replace(":1", ":2")), None);
    }
}
