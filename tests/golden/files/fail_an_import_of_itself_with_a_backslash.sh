# RUN: printf 'import ".\\house.kb"\nimport "rooms\\Door"\nfact A\n' > %t/house.kb; mkdir %t/rooms; echo 'fact Door' > %t/rooms/Door.kb; cd %t; kbc check house.kb
