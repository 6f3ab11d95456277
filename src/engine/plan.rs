//! What a world needs from a step: which stages, which springs are forces and which are rows.
//! Derived from the world and the method, shown to the user, rebuilt only when one of them changed.
