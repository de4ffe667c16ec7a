"""What goes over the wire: request and answer bodies, as OpenAPI shows them."""
