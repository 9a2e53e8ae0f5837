#error "a header of the project stands in the way of one of Waymark"
