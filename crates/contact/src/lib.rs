//! Who touches whom, how hard, over what length?
