//! The self-supporting envelope that keeps support clear of the model below.
