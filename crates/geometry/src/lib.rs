//! What shape is a gear pair, exactly?
